#pragma once

#include "mesh/generate.h"
#include "support/soft_scene.h"

#include <cmath>
#include <random>

namespace ode::soft {

inline Solid rubber(double young = 1e6, double density = 1000, double poisson = 0.3) {
    Solid s;
    s.young = young;
    s.poisson = poisson;
    s.density = density;
    return s;
}

/// What the contact of two thrown cubes keeps.
struct ThrowOutcome {
    double change;   ///< of energy, at the end [-]
    double highest;  ///< on the way [-]
    double momentum; ///< changes, of what moved at first
    double angular;
    bool met;
    SoftContactTally tally;
    double near_substeps = 0; ///< in which points or tetrahedra were tested
    double seconds;           ///< CPU of contact alone
};

struct CubeThrow {
    unsigned seed = 0;
    double speed = 1;      ///< [m/s]
    double density = 1000; ///< of the second [kg/m^3]
    double young = 1e6;    ///< of the second [Pa]
    double friction = 0;
    int cells = 3;
    double share = 0.7; ///< of the critical step
    bool by_volume = false;
};

/// Two cubes of 10 cm thrown at each other, turned and spinning at random.
inline ThrowOutcome throw_cubes(const CubeThrow& t) {
    constexpr double kStep = 4e-3; // of ODE [s]
    std::mt19937 random(t.seed);
    std::uniform_real_distribution<double> u(-1, 1);
    const auto turn = [&] { return Quat(u(random), u(random), u(random), u(random)).normalized(); };
    const auto spin = [&] { return Vec3(5 * t.speed * Vec3(u(random), u(random), u(random))); };
    SoftScene scene;
    const auto cube = [&] { return make_box({0.1, 0.1, 0.1}, t.cells, t.cells, t.cells); };
    SceneBody& a = scene.add(cube(), rubber());
    SceneBody& b = scene.add(cube(), rubber(t.young, t.density));
    a.law.friction = b.law.friction = t.friction;
    a.place({-0.09, 0.02 * u(random), 0.02 * u(random)}, turn(), {t.speed / 2, 0, 0}, spin());
    b.place({0.09, 0.02 * u(random), 0.02 * u(random)}, turn(), {-t.speed / 2, 0, 0}, spin());
    const double dt = t.share * std::min(a.critical, b.critical);
    scene.begin(dt, t.by_volume);
    scene.begin_step();
    const double first = scene.advance_and_measure();
    const Vec3 linear = scene.momentum();
    const Vec3 angular = scene.angular_momentum();
    const double moved = a.mass() * a.velocity().norm() + b.mass() * b.velocity().norm();
    ThrowOutcome out{};
    double last = first;
    const auto every = std::max(1L, std::lround(kStep / dt));
    const auto substeps = std::lround(0.3 / t.speed / dt);
    for (long i = 0; i < substeps; ++i) {
        if (i % every == 0)
            scene.begin_step();
        const unsigned long tests = scene.tally.tests;
        const double now = scene.advance_and_measure();
        out.near_substeps += scene.tally.tests != tests;
        out.highest = std::fmax(out.highest, now / first - 1);
        out.met |= scene.bearing > 0;
        if (scene.bearing == 0)
            last = now;
    }
    out.change = last / first - 1;
    out.momentum = (scene.momentum() - linear).norm() / moved;
    out.angular = (scene.angular_momentum() - angular).norm() / (0.1 * moved);
    out.tally = scene.tally;
    out.seconds = scene.contact_seconds;
    return out;
}

} // namespace ode::soft
