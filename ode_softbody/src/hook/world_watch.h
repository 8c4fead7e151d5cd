#pragma once

#include <ode/collision.h>
#include <ode/objects.h>

namespace ode::soft {

/// Tells whether an ODE world still exists, where its end can't be caught: a disabled body that
/// ODE's steps pass over, with a geom in no space, from which ODE takes the body when the world
/// ends.
class WorldWatch {
public:
    explicit WorldWatch(dWorldID world)
        : body_(dBodyCreate(world)), geom_(dCreateSphere(nullptr, 1)) {
        dBodyDisable(body_);
        dGeomSetBody(geom_, body_);
    }
    ~WorldWatch() {
        if (!gone())
            dBodyDestroy(body_);
        dGeomDestroy(geom_);
    }
    WorldWatch(const WorldWatch&) = delete;
    WorldWatch& operator=(const WorldWatch&) = delete;

    bool gone() const noexcept { return dGeomGetBody(geom_) == nullptr; }

private:
    dBodyID body_;
    dGeomID geom_;
};

} // namespace ode::soft
