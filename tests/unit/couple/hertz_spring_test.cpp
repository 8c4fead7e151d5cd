#include "couple/hertz_spring.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode::soft {
namespace {

// Rubber ball of 1 cm on a floor.
constexpr double kHertz = 1.5e6;     // [N/m^1.5]
constexpr double kCompliance = 2e-5; // [m/N]

TEST(HertzSpring, IsHertzLessTheMesh) {
    const HertzSpring spring(kHertz, kCompliance, 1);
    for (const double force : {1e-6, 0.01, 0.3, 1.0}) {
        const double depth = std::pow(force / kHertz, 2.0 / 3) - kCompliance * force;
        ASSERT_LT(depth, spring.end_depth());
        EXPECT_NEAR(spring.force(depth), force, 1e-12 * force);
    }
}

TEST(HertzSpring, ForceIsTheDerivativeOfEnergy) {
    const HertzSpring spring(kHertz, kCompliance, 1);
    for (double depth = 0.05; depth < 3; depth += 0.1) { // in the end depth
        const double d = depth * spring.end_depth();
        const double step = 1e-5 * spring.end_depth();
        const double slope = (spring.energy(d + step) - spring.energy(d - step)) / (2 * step);
        EXPECT_NEAR(spring.force(d), slope, 1e-6 * slope) << depth;
    }
}

// Where the mesh is the spring nothing but a steep straight line is left.
TEST(HertzSpring, IsCappedWhereTheMeshIsTheSpring) {
    const HertzSpring spring(kHertz, kCompliance, 1);
    const double d = spring.end_depth();
    const double share =
        kCompliance * spring.end_force() / (d + kCompliance * spring.end_force()); // C F / delta
    EXPECT_GT(share, 0.5);
    EXPECT_LT(share, 2.0 / 3);
    EXPECT_NEAR(spring.force(2 * d) - spring.force(d), spring.steep() * d, 1e-9);
    EXPECT_NEAR(spring.steep() * kCompliance, HertzSpring::kSteepness, 1e-12);
    EXPECT_DOUBLE_EQ(HertzSpring(kHertz, kCompliance, d / 2).end_depth(), d / 2);
}

// A mass thrown on it comes back as fast as it came, at any substep: up to a few to a contact.
TEST(HertzSpring, ReturnsAMassAtAnySubstep) {
    const HertzSpring spring(kHertz, kCompliance, 1);
    for (const double dt : {1e-6, 1e-5, 1e-4, 1e-3}) {
        const double mass = 4e-3;
        double speed = -0.3; // half a substep ago, up
        double height = 0.37 * 0.3 * dt;
        int bearing = 0;
        for (int i = 0; i < 100000 && height < 1e-2; ++i) {
            const double a = -(height - dt * speed);
            const double force = spring.press(dt * dt / mass, a, -(height + dt * speed));
            bearing += force > 0;
            speed += dt * force / mass;
            height += dt * speed;
        }
        EXPECT_GT(bearing, 0);
        EXPECT_NEAR(speed, 0.3, 1e-9) << dt;
    }
}

// Curvatures of 4 : 1. The elliptic integrals (Johnson 4.26-4.32, by arithmetic-geometric means)
// give F2 = 0.9743.
TEST(HertzSpring, EllipsesAreALittleStiffer) {
    const double circle = hertz_stiffness(1, 1, 1);
    EXPECT_DOUBLE_EQ(circle, 4.0 / 3);
    EXPECT_NEAR(hertz_stiffness(1, 2, 0.5) / circle, std::pow(0.9743, -1.5), 0.01);
}

} // namespace
} // namespace ode::soft
