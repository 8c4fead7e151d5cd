// Rigid shapes thrown and shot at free, elastic, undamped soft bodies: what is kept, what leaks,
// what pierces.
#include "mesh/generate.h"
#include "physics/contact/thrown_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace ode::soft {
namespace {

struct Tally {
    double mean = 0;
    double gain = 0;
    double loss = 0;
    double depth = 0;
    double momentum = 0;
    double slowest = HUGE_VAL; ///< of the rigid bodies at the end, along +z [m/s]
};

/// Random throws, tilted and spinning, at the middle of the upper face.
Tally throw_many(ThrownScene& scene, Throw what, double speed, int throws) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    Tally tally;
    for (int i = 0; i < throws; ++i) {
        what.turn =
            Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
        what.spin = 5 * speed * Vec3(normal(random), normal(random), normal(random));
        what.velocity = speed * Vec3(0.05, 0.1, -1);
        what.at = Vec3(0.013, -0.007, 2 * what.size);
        const Outcome o = scene.run(what);
        EXPECT_GT(o.bearing, 0);
        tally.mean += std::fabs(o.energy) / throws;
        tally.gain = std::fmax(tally.gain, o.energy);
        tally.loss = std::fmin(tally.loss, o.energy);
        tally.depth = std::fmax(tally.depth, o.depth);
        tally.momentum = std::fmax(tally.momentum, o.momentum);
        tally.slowest = std::fmin(tally.slowest, o.velocity.z());
    }
    return tally;
}

void print(const char* target, const Throw& what, double speed, const Tally& t) {
    std::printf("%-8s %7.4f kg, %3.0f m/s at a %s: energy mean %.1e, worst %+.1e %+.1e; depth "
                "%.2f mm; leaves at %.2f m/s or more\n",
                name_of(what.kind), what.mass, speed, target, t.mean, t.gain, t.loss, 1e3 * t.depth,
                t.slowest);
}

class ThrownShape : public testing::TestWithParam<Thrown> {};

// At 2 m/s. Masses of 0.0025 to 6 times the plate's, 0.03 to 5 times the cube's.
TEST_P(ThrownShape, KeepsItsEnergyAndDoesNotPierce) {
    Throw what;
    what.kind = GetParam();
    what.seconds = 0.04;
    ThrownScene plate(make_plate(0.2, 0.2, 0.02, 10, 10, 1), 2e7, 1000, 1e-5);
    ThrownScene cube(make_box({0.1, 0.1, 0.1}, 4, 4, 4), 1e6, 1000, 4e-5);
    double mean = 0;
    for (const double mass : {0.002, 0.3, 5.0}) {
        what.mass = mass;
        const Tally t = throw_many(plate, what, 2, 4);
        print("plate", what, 2, t);
        mean += t.mean / 6;
        EXPECT_LT(t.gain, 1e-3) << mass;
        EXPECT_GT(t.loss, -1e-3) << mass;
        EXPECT_LT(t.depth, 1e-3) << mass;
        EXPECT_LT(t.momentum, 1e-13) << mass;
    }
    what.seconds = 0.06; // all have parted: springs aren't counted
    for (const double mass : {0.03, 0.3, 5.0}) {
        what.mass = mass;
        const Tally t = throw_many(cube, what, 2, 4);
        print("cube", what, 2, t);
        mean += t.mean / 6;
        EXPECT_LT(t.gain, 1e-3) << mass;
        EXPECT_GT(t.loss, -1e-3) << mass;
        EXPECT_LT(t.momentum, 1e-13) << mass;
    }
    EXPECT_LT(mean, 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ThrownShape, testing::ValuesIn(kThrown));

// Onto the middle of a face: no node is within its radius.
TEST(ThrownBall, BouncesBetweenNodes) {
    ThrownScene scene(make_plate(0.2, 0.2, 0.02, 10, 10, 1), 2e7, 1000, 1e-5);
    Throw what;
    what.kind = Thrown::sphere;
    what.size = 0.005;
    what.mass = 0.004;
    what.at = {0.0133, 0.0067, 0.01};
    what.velocity = {0, 0, -2};
    what.seconds = 0.02;
    const Outcome o = scene.run(what);
    std::printf("ball: energy error %+.2e; depth %.2f mm; leaves at %.2f m/s\n", o.energy,
                1e3 * o.depth, o.velocity.z());
    EXPECT_GT(o.velocity.z(), 0);
    EXPECT_LT(std::fabs(o.energy), 1e-3);
}

class Shot : public testing::TestWithParam<Thrown> {};

// 100 m/s is 1 mm a substep against a plate of 20 mm, and 0.7 of the plate's wave speed. A few
// grams and less, so that the plate can stop them at all; they spin at 500 rad/s before and at some
// thousand after, so that a substep turns them by several degrees.
TEST_P(Shot, NeitherTunnelsNorGainsNorLosesEnergy) {
    ThrownScene scene(make_plate(0.2, 0.2, 0.02, 10, 10, 1), 2e7, 1000, 1e-5);
    Throw what;
    what.kind = GetParam();
    what.size = 0.006;
    what.seconds = 0.003;
    for (const double mass : {0.0002, 0.002, 0.01}) {
        what.mass = mass;
        const Tally t = throw_many(scene, what, 100, 8);
        print("plate", what, 100, t);
        EXPECT_LT(t.mean, 5e-3) << mass;
        EXPECT_LT(t.gain, 1e-2) << mass;
        EXPECT_GT(t.loss, -2e-2) << mass;
        EXPECT_LT(t.depth, 8e-3) << mass;
        EXPECT_GT(t.slowest, 0) << mass;
        EXPECT_LT(t.momentum, 1e-13) << mass;
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Shot, testing::ValuesIn(kThrown));

// A stiff, heavy block that a card of a gram falls on flat and on its edge: the springs of its
// nodes are thousands of times what an explicit step would bear on the card.
TEST(ThrownCard, LightAsItIsKeepsItsEnergy) {
    ThrownScene scene(make_box({0.1, 0.1, 0.05}, 6, 6, 3), 2e7, 8000, 3e-6);
    Throw what;
    what.kind = Thrown::box;
    what.size = 0.03;
    what.mass = 0.001;
    what.seconds = 0.02;
    const Tally t = throw_many(scene, what, 5, 4);
    print("block", what, 5, t);
    EXPECT_LT(t.mean, 5e-3);
    EXPECT_LT(t.gain, 1e-2);
    EXPECT_GT(t.slowest, 0);
}

// Friction and dashpots only take.
TEST(ThrownCard, WithFrictionAndDampingOnlyLoses) {
    ThrownScene scene(make_plate(0.2, 0.2, 0.02, 10, 10, 1), 2e7, 1000, 1e-5);
    for (const Thrown kind : kThrown)
        for (const double damping : {0.0, 3e-5}) {
            Throw what;
            what.kind = kind;
            what.mass = 0.005;
            what.friction = 0.5;
            what.damping = damping;
            const Tally t = throw_many(scene, what, 3, 1);
            print(damping > 0 ? "plate, rough and damped" : "plate, rough", what, 3, t);
            EXPECT_LT(t.gain, 1e-3) << name_of(kind);
        }
}

} // namespace
} // namespace ode::soft
