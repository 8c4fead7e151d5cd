// The watch over stability: a body that leaves its energy budget is found out at once and taken
// back, and neither rigid bodies nor observers notice more than they must.
#include "stability/scene.h"

#include "mesh/generate.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace ode::test {
namespace {

using namespace ode::soft;

const Solid kRubber = solid_of(1e6, 0.3, 1000);
const Vec3 kCube(0.1, 0.1, 0.1);

/// Every node gets a velocity of its own: all modes ring.
void shake(Body& body, double speed) {
    std::mt19937 bits(5);
    const auto random = [&] { return 2 * double(bits()) / double(std::mt19937::max()) - 1; };
    set_velocities(body, [&](const Vec3&) {
        const double x = random(), y = random(), z = random();
        return Vec3(speed * x, speed * y, speed * z);
    });
}

/// Looks at what a body truly holds, in every substep shown.
class Observing final : public Observer {
public:
    bool wants_substeps() const noexcept override { return true; }
    void on_substep(const SubstepView& view) noexcept override {
        orderly &= std::abs(view.time - view.dt - last_time) < 1e-12 && view.dt > 0;
        last_time = view.time;
        const double energy = view.body.kinetic_energy() + view.body.elastic_energy();
        most = std::max(most, energy);
        if (energy > bound)
            ++beyond;
        ++views;
    }
    void on_step(SoftWorld&, double) noexcept override {}
    void on_body_end(Body&) noexcept override {}
    void on_world_end(SoftWorld&) noexcept override {}

    double bound = 0, most = 0, last_time = 0;
    int beyond = 0, views = 0;
    bool orderly = true;
};

class BeyondTheCriticalStep : public testing::TestWithParam<double> {};

// Leaving the budget is holding ten times what is due; from there on at most ten substeps are
// taken.
TEST_P(BeyondTheCriticalStep, IsFoundWithinTenSubstepsAndRedone) {
    Scene scene;
    Body& cube = scene.add(make_box(kCube, 2, 2, 2), kRubber);
    shake(cube, 0.05);
    cube.set_substep(GetParam() * cube.critical_step());
    auto owned = std::make_unique<Observing>();
    Observing& seen = *owned;
    seen.bound = EnergyBudget::kMost * cube.kinetic_energy();
    const double energy = cube.kinetic_energy();
    scene.soft->add_observer(std::move(owned));
    scene.run(0.5, 0.005);
    EXPECT_TRUE(scene.verdict().recovered()) << scene.verdict().outcome();
    EXPECT_GT(cube.rollbacks(), 0);
    EXPECT_TRUE(scene.verdict().was_told("is redone at"));
    EXPECT_LE(seen.beyond, 10);
    EXPECT_TRUE(seen.orderly); // each moment once
    EXPECT_NEAR(seen.last_time, 0.5, 1e-9);
    // What it rings with in the end is what it was given.
    EXPECT_LE(cube.budget().energy(), EnergyBudget::kMost * energy);
}
INSTANTIATE_TEST_SUITE_P(Steps, BeyondTheCriticalStep, testing::Values(1.06, 1.2, 1.5, 2.0, 4.0));

// A stable body is never taken back, however its energy swings: near the critical step, in all
// modes at once, in free flight, held and falling, struck.
TEST(Watch, LeavesStableBodiesAlone) {
    for (const double share : {0.1, 0.5, 0.9, 0.97})
        for (const bool held : {false, true}) {
            Scene scene(-9.81);
            Body& cube = scene.add(make_box(kCube, 2, 2, 2), kRubber);
            cube.set_velocity({3, -2, 1});
            shake(cube, 0.05);
            if (held) {
                const int corner[] = {0};
                cube.pin(corner);
            }
            cube.set_substep(share * cube.critical_step());
            scene.run(0.5, 1.0 / 60);
            EXPECT_EQ(cube.rollbacks(), 0)
                << share << " " << held << " "
                << (scene.verdict().told.empty() ? "" : scene.verdict().told.front());
            EXPECT_LT(scene.verdict().energy_share, EnergyBudget::kMost);
        }
}

// A force on a node of a body that is wholly at rest, however late and strong.
TEST(Watch, LeavesABodyAloneThatIsPushed) {
    for (const bool held : {false, true}) {
        Scene scene;
        Body& bar = scene.add(make_bar(0.2, 0.03, 0.02, 10, 1, 1), solid_of(200e9, 0.29, 7850));
        if (held) {
            const int nodes[] = {0, 1, 2};
            bar.pin(nodes);
        }
        for (int i = 0; i < 10; ++i) {
            if (i == 2 || i == 6)
                bar.add_force(40, {0, 10, 200});
            scene.step(0.002);
        }
        EXPECT_EQ(bar.rollbacks(), 0) << held;
        EXPECT_GT(bar.budget().energy(), 0);
    }
}

// Momentum: what a ball got in an attempt that was taken back it doesn't keep.
TEST(Watch, AStepThatIsRedoneGivesNoImpulseTwice) {
    for (const double share : {0.9, 1.3, 3.0}) {
        Scene scene;
        Body& cube = scene.add(make_box(kCube, 3, 3, 3), kRubber);
        cube.set_substep(share * cube.critical_step());
        shake(cube, 0.05);
        const Vec3 start = cube.linear_momentum();
        const dBodyID ball = scene.add_ball(0.04, 0.5, {0.01, 0, 0.1}, {0, 0, -3});
        scene.run(0.1, 0.004);
        const dReal* v = dBodyGetLinearVel(ball);
        const Vec3 sum = cube.linear_momentum() + 0.5 * Vec3(v[0], v[1], v[2]);
        EXPECT_GT(v[2], -1.5) << share; // they have met
        EXPECT_FALSE(cube.stopped());
        EXPECT_NEAR((sum - start - Vec3(0, 0, -1.5)).norm(), 0, 1e-10) << share;
        EXPECT_EQ(cube.rollbacks() > 0, share > 1) << share;
    }
}

// The redone step is the step of a body that had the shorter substep from the start, to the bit.
TEST(Watch, ARedoneStepIsAsIfNothingHadHappened) {
    const auto run = [](double share, int& rollbacks) {
        Scene scene(-9.81);
        Solid damped = kRubber;
        damped.alpha = 20;
        Body& cube = scene.add(make_box(kCube, 2, 2, 2), damped);
        shake(cube, 0.05);
        cube.set_substep(share * cube.critical_step());
        scene.run(0.004, 0.004);
        rollbacks = cube.rollbacks();
        return cube.state();
    };
    int taken = 0, none = 0;
    const NodeState redone = run(1.7, taken), straight = run(1.7 / 2, none);
    EXPECT_EQ(taken, 1);
    EXPECT_EQ(none, 0);
    const std::size_t bytes = 4 * sizeof(double) * redone.position.size();
    EXPECT_EQ(std::memcmp(redone.position.data(), straight.position.data(), bytes), 0);
    EXPECT_EQ(std::memcmp(redone.velocity.data(), straight.velocity.data(), bytes), 0);
}

// Explicit Euler grows at any step: nothing helps, so it is stopped, told, and the rest goes on.
TEST(Watch, WhatNoStepHelpsIsStoppedAndTold) {
    Scene scene(-9.81);
    Body& euler = scene.add(make_box(kCube, 2, 2, 2), kRubber, "stvk", 1, "explicit-euler");
    Body& other = scene.add(make_box(kCube, 2, 2, 2), kRubber);
    other.move_to({1, 0, 0});
    shake(euler, 0.05);
    scene.run(0.5, 0.005);
    EXPECT_TRUE(euler.stopped());
    EXPECT_FALSE(other.stopped());
    EXPECT_TRUE(scene.verdict().was_told("is stopped")) << scene.verdict().outcome();
    EXPECT_TRUE(scene.verdict().world_intact);
    EXPECT_NEAR(other.center_of_mass().z(), -9.81 * 0.5 * 0.5 / 2, 1e-9);
}

// A flight starts as the parabola says, at any steps: gravity is in the half kick too.
TEST(Watch, FreeFallIsExactAtAnySteps) {
    Scene scene(-9.81);
    Body& cube = scene.add(make_box(kCube, 2, 2, 2), kRubber);
    const double start = cube.center_of_mass().z();
    double time = 0;
    for (const double h : {0.01, 0.001, 0.03, 0.0007, 0.02, 0.015, 0.1}) {
        scene.step(h);
        time += h;
    }
    EXPECT_NEAR(cube.center_of_mass().z(), start - 9.81 * time * time / 2, 1e-12);
}

// Newton's method on a step that is far too long for what happens in it.
TEST(Watch, ASolutionNotFoundIsToldAndTheStepRedone) {
    Scene scene;
    Body& cube = scene.add(make_box(kCube, 2, 2, 2), kRubber, "stvk", 1, "backward-euler");
    shake(cube, 100);
    cube.set_substep(0.02);
    scene.run(0.02, 0.02);
    EXPECT_GT(cube.failed_solves(), 0);
    EXPECT_TRUE(scene.verdict().was_told("found no solution"));
    EXPECT_TRUE(scene.verdict().is_honest()) << scene.verdict().outcome();
}

// An element may turn inside out and find back; it doesn't go unnoticed.
TEST(Watch, InvertedElementsAreTold) {
    Scene scene;
    Body& cube = scene.add(make_box(kCube, 2, 2, 2), kRubber, "stable-neo-hookean");
    cube.set_substep(0.1 * cube.critical_step());
    deform(cube, [](const Vec3& x) { return Vec3(x.x(), x.y(), -0.2 * x.z()); });
    scene.run(0.02, 0.002);
    EXPECT_TRUE(scene.verdict().was_told("inside out"));
    EXPECT_LT(scene.verdict().least_jacobian, 0);
    EXPECT_TRUE(scene.verdict().is_honest());
}

} // namespace
} // namespace ode::test
