#pragma once

#include "world/soft_world.h"

#include <ode/ode.h>

#include <cstdarg>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ode::test {

/// What was seen of soft bodies under stress.
struct Verdict {
    bool finite = true;        ///< every node, at every step
    bool world_intact = true;  ///< a ball that flies beside them flies as alone
    bool stopped = false;      ///< some body
    int rollbacks = 0;         ///< of all bodies
    double least_jacobian = 1; ///< ever
    double last_jacobian = 1;
    double energy_share = 0; ///< largest, of what was due, of those looks that passed
    std::vector<std::string> told;

    bool was_told(const std::string& words) const;
    /// Neither a number that is none, nor an inversion or a stop that nobody was told of.
    bool is_honest() const;
    bool recovered() const { return is_honest() && !stopped && last_jacobian > 0; }
    std::string outcome() const; ///< in a word or two
};

/// A world of soft bodies and ODE's, watched step by step.
class Scene {
public:
    explicit Scene(double gravity = 0);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    soft::Body& add(const soft::TetMesh& mesh, const soft::Solid& solid,
                    const std::string& law = "stvk", int order = 1,
                    const std::string& integrator = "central-difference");
    dBodyID add_ball(double radius, double mass, const soft::Vec3& at, const soft::Vec3& velocity);
    dBodyID add_box(const soft::Vec3& size, double mass, const soft::Vec3& at);
    void add_floor() { dCreatePlane(space, 0, 0, 1, 0); }

    /// Called with every scene as it is made: how others look at the suite's motion.
    static inline std::function<void(Scene&)> on_create;

    void step(double h);
    /// @param seconds  in steps of h.
    void run(double seconds, double h);
    const Verdict& verdict() const { return verdict_; }

    dWorldID world;
    dSpaceID space;
    std::unique_ptr<soft::SoftWorld> soft;

private:
    static void hear(int, const char* text, va_list arguments);
    static void near(void* data, dGeomID a, dGeomID b);

    Verdict verdict_;
    dBodyID witness_; ///< flies far away from all
    double time_ = 0;
    dJointGroupID contacts_;
};

/// Isotropic and undamped [Pa, -, kg/m^3].
soft::Solid solid_of(double young, double poisson, double density);
/// Of longitudinal waves [m/s].
double wave_speed(const soft::Solid& solid);
/// Moves every node of a body to where it is told to be, by its rest position about the middle.
void deform(soft::Body& body, const std::function<soft::Vec3(const soft::Vec3&)>& place);
void set_velocities(soft::Body& body, const std::function<soft::Vec3(const soft::Vec3&)>& velocity);

} // namespace ode::test
