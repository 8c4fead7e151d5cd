#include "couple/rigid_shadow.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace ode::soft {
namespace {

/// A free sphere of 0.1 kg at 1 m/s rebounds from a massless spring that ends at x = 0, all inside
/// ODE's steps of length h. Where coupling through averaged or lagged forces multiplies the energy
/// by up to 5.6e6 (k = 1e6, h = 16 ms), the shadow has to return it.
struct Case {
    double stiffness; ///< [N/m]
    double h;         ///< [s]
};

class SpringRebound : public testing::TestWithParam<Case> {};

/// @param start  distance from the spring at first [m].
/// @return energy kept, peak force.
std::pair<double, double> rebound(const Case& c, double start) {
    const double dt = 1e-5;
    const dWorldID world = dWorldCreate();
    const dBodyID sphere = dBodyCreate(world);
    dMass mass;
    dMassSetSphereTotal(&mass, 0.1, 0.02);
    dBodySetMass(sphere, &mass);
    dBodySetPosition(sphere, start, 0, 0);
    dBodySetLinearVel(sphere, -1, 0, 0);
    double hardest = 0;
    const auto substeps = std::lround(c.h / dt);
    for (double t = 0; t < 0.1; t += c.h) {
        RigidShadow shadow(sphere, c.h, dt);
        for (long i = 0; i < substeps; ++i) {
            const double x = shadow.motion().pose.position.x();
            if (x < 0) {
                shadow.add({Vec3(-c.stiffness * x, 0, 0), Vec3::Zero()});
                hardest = std::fmax(hardest, -c.stiffness * x);
            }
            shadow.advance(dt);
        }
        shadow.hand_over();
        dWorldQuickStep(world, c.h);
        shadow.write_back();
    }
    const double v = dBodyGetLinearVel(sphere)[0];
    dWorldDestroy(world);
    return {v * std::fabs(v), hardest};
}

TEST_P(SpringRebound, ReturnsTheEnergy) {
    const Case& c = GetParam();
    const double phase = c.stiffness / 0.1 * 1e-10; // (omega dt)^2
    dInitODE2(0);
    double mean = 0;
    const int starts = 16;
    for (int i = 0; i < starts; ++i) {
        const auto [energy, hardest] = rebound(c, 3.4e-3 + 1e-5 * i / starts);
        // Leapfrog in the spring keeps m v^2 + k x_n x_n+1; that product is -a (1 - a) (v dt)^2
        // where a substep crosses the spring's end, so a crossing is worth at most a quarter of
        // phase.
        EXPECT_NEAR(energy, 1, phase / 4 + 1e-12);
        EXPECT_NEAR(hardest, std::sqrt(c.stiffness * 0.1), phase * std::sqrt(c.stiffness * 0.1));
        mean += energy / starts;
    }
    std::printf("k %5g N/m  h %2.0f ms  E/E0 %.6f\n", c.stiffness, 1e3 * c.h, mean);
    EXPECT_NEAR(mean, 1, 1e-4); // crossings at random phase cancel
    dCloseODE();
}

INSTANTIATE_TEST_SUITE_P(StiffnessAndStep, SpringRebound,
                         testing::Values(Case{1e6, 1e-3}, Case{1e6, 5e-3}, Case{1e6, 16e-3},
                                         Case{2e4, 1e-3}, Case{2e4, 5e-3}, Case{2e4, 16e-3}));

} // namespace
} // namespace ode::soft
