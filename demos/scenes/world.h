#pragma once

#include <ode/ode.h>
#include <ode_softbody/softbody.hpp>
#include <stdexcept>

/// Scenes: what demos, tests and benchmarks have in common. A scene is a function that builds an
/// ODE world with soft bodies in it.
namespace scenes {

/// The library declined; its sentence has gone through ODE's message handler already.
struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// @return what was made. @throws Refused when it is null.
template <class Id>
Id made(Id id) {
    if (!id)
        throw Refused("refused by the library");
    return id;
}

/// An ODE world as its applications write it: one space, contact joints made afresh each step by
/// a near callback that knows nothing of soft bodies. dInitODE2 must have been called.
class World {
public:
    /// Gravity is 9.81 m/s^2 along -z; there is no floor yet.
    World();
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    dWorldID ode() const { return ode_; }
    dSpaceID space() const { return space_; }
    dSoftWorldID soft() const { return soft_; }

    /// Collides, then advances by h [s] with dWorldQuickStep.
    void step(double h);

private:
    dWorldID ode_;
    dSpaceID space_;
    dJointGroupID contacts_;
    dSoftWorldID soft_;
};

} // namespace scenes
