// Heaps of soft and rigid bodies, the short form of bench_pile.
#include "scenes/pile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using scenes::Pile;
using scenes::PileBodies;
using scenes::PileState;

constexpr double kStep = 1.0 / 240; ///< [s]

/// ODE from dInitODE2 to dCloseODE, round a world.
struct Ode {
    Ode() { dInitODE2(0); }
    ~Ode() { dCloseODE(); }
    Ode(const Ode&) = delete;
    Ode& operator=(const Ode&) = delete;
};
struct Heap : Ode {
    explicit Heap(const Pile& pile) : bodies(build(world, pile)) {}

    PileState look() const { return look_at(bodies, gravity); }
    dSoftWorldStats stats() const {
        dSoftWorldStats s{};
        s.struct_size = sizeof s;
        dSoftWorldGetStats(world.soft(), &s);
        return s;
    }
    long awake() const {
        return std::count_if(bodies.soft.begin(), bodies.soft.end(), dSoftBodyIsEnabled) +
               std::count_if(bodies.rigid.begin(), bodies.rigid.end(), dBodyIsEnabled);
    }

    scenes::World world;
    PileBodies bodies;
    double gravity = 9.81;
};

Pile short_pile() {
    Pile pile;
    pile.soft = 12;
    pile.rigid = 3;
    return pile;
}

void expect_untunnelled(const Heap& heap, const PileState& state) {
    EXPECT_FALSE(state.any_stopped);
    EXPECT_GT(state.lowest, 0);
    EXPECT_LT(state.widest, heap.bodies.half);
    EXPECT_GT(state.closest, 0.02) << "two slabs of 5 cm have their middles in each other";
}

TEST(Pile, SettlesWithoutGainAndFallsAsleep) {
    Pile pile = short_pile();
    pile.may_rest = true;
    Heap heap(pile);
    const PileState first = heap.look();
    double lowest = first.energy();
    double rise = 0;
    int steps = 0;
    for (; steps < 12 / kStep && heap.awake() > 0; ++steps) {
        heap.world.step(kStep);
        const PileState now = heap.look();
        rise = std::max(rise, now.energy() - lowest);
        lowest = std::min(lowest, now.energy());
    }
    const PileState last = heap.look();
    const double fall = first.energy() - last.energy();
    std::printf(
        "asleep after %.2f s; energy %.3f to %.3f J, rose by %.2e of the fall; lowest %.3f, "
        "widest %.3f of %.3f, closest %.3f m\n",
        steps * kStep, first.energy(), last.energy(), rise / fall, last.lowest, last.widest,
        heap.bodies.half, last.closest);
    expect_untunnelled(heap, last);
    EXPECT_LT(rise, 0.01 * fall) << "the mark for a gain";
    ASSERT_EQ(heap.awake(), 0);
    EXPECT_LT(last.kinetic, 1e-5 * fall);

    // Asleep nothing is stepped, and nothing moves.
    const dSoftWorldStats before = heap.stats();
    for (int i = 0; i < 100; ++i)
        heap.world.step(kStep);
    const dSoftWorldStats after = heap.stats();
    EXPECT_EQ(after.steps, before.steps + 100);
    EXPECT_EQ(after.body_substeps, before.body_substeps);
    EXPECT_EQ(after.rigid_contacts, before.rigid_contacts);
    EXPECT_EQ(after.substeps, before.substeps);
    EXPECT_EQ(after.element_steps, before.element_steps);
    EXPECT_EQ(after.soft_looks, before.soft_looks);
    EXPECT_EQ(after.contact_tests, before.contact_tests);
    EXPECT_EQ(heap.look().potential, last.potential);

    // A touch wakes the heap; it lies as it lay and goes back to sleep.
    dSoftBodyAddForceAtNode(heap.bodies.soft.front(), 0, 0, 0, 1e-3);
    heap.world.step(kStep);
    EXPECT_GT(heap.awake(), 0);
    for (int i = 0; i < 4 / kStep && heap.awake() > 0; ++i) {
        heap.world.step(kStep);
        EXPECT_LT(heap.look().fastest, 0.05);
    }
    EXPECT_EQ(heap.awake(), 0);
    EXPECT_NEAR(heap.look().potential, last.potential, 1e-3 * fall);
}

TEST(Pile, ThrownTogetherKeepsMomenta) {
    Pile pile = short_pile();
    pile.bin = false;
    Heap heap(pile);
    heap.gravity = 0;
    const PileState first = heap.look();
    double highest = first.energy();
    for (int i = 0; i < 1 / kStep; ++i) {
        heap.world.step(kStep);
        highest = std::max(highest, heap.look().energy());
    }
    const PileState last = heap.look();
    const double linear =
        std::hypot(last.momentum[0] - first.momentum[0], last.momentum[1] - first.momentum[1],
                   last.momentum[2] - first.momentum[2]);
    const double angular =
        std::hypot(last.angular[0] - first.angular[0], last.angular[1] - first.angular[1],
                   last.angular[2] - first.angular[2]);
    std::printf("momentum %.1e, angular %.1e of what moved; energy %.3f to %.3f J, highest %+.1e\n",
                linear / first.throughput, angular / (0.3 * first.throughput), first.energy(),
                last.energy(), highest / first.energy() - 1);
    EXPECT_FALSE(last.any_stopped);
    EXPECT_GT(heap.stats().contact_points, 1000u);
    EXPECT_LT(linear, 1e-10 * first.throughput);
    EXPECT_LT(highest, 1.01 * first.energy());
}

// What lies elsewhere sleeps on.
TEST(Pile, ABlowWakesItsOwnNeighboursOnly) {
    Ode ode;
    scenes::World world;
    dWorldSetAutoDisableFlag(world.ode(), 1);
    dCreatePlane(world.space(), 0, 0, 1, 0);
    const ode::soft::MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 2, 2, 2));
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = 1e5;
    solid.poisson = 0.3;
    solid.density = 500;
    solid.alpha = 20;
    solid.beta = 2e-3;
    std::vector<dSoftBodyID> cube;
    for (const double x : {0.0, 0.1, 1.0}) { // two near each other, one apart
        cube.push_back(dSoftBodyCreate(world.soft(), mesh, &solid));
        dSoftBodySetPosition(cube.back(), x, 0, 0.051);
    }
    EXPECT_EQ(dSoftBodyGetAutoDisableFlag(cube[0]), 1) << "inherited from the world";
    const auto enabled = [&](std::size_t i) { return dSoftBodyIsEnabled(cube[i]); };
    for (int i = 0; i < 5 / kStep && (enabled(0) || enabled(1) || enabled(2)); ++i)
        world.step(kStep);
    ASSERT_FALSE(enabled(0) || enabled(1) || enabled(2));

    // A ball falls on the first.
    const dBodyID ball = dBodyCreate(world.ode());
    dMass mass;
    dMassSetSphereTotal(&mass, 0.1, 0.02);
    dBodySetMass(ball, &mass);
    dGeomSetBody(dCreateSphere(world.space(), 0.02), ball);
    dBodySetPosition(ball, -0.03, 0, 0.5);
    dBodySetAutoDisableFlag(ball, 0);
    world.step(kStep);
    EXPECT_FALSE(enabled(0)) << "it is far yet";
    double lowest = 1;
    for (int i = 0; i < 0.5 / kStep; ++i) {
        world.step(kStep);
        lowest = std::min(lowest, static_cast<double>(dBodyGetPosition(ball)[2]));
        EXPECT_FALSE(enabled(2));
    }
    EXPECT_TRUE(enabled(0));
    EXPECT_TRUE(enabled(1)) << "near the first";
    EXPECT_GT(lowest, 0.08) << "it met a soft cube of 10 cm";
}

// A joint is substepped while its body is near a soft one.
TEST(Pile, JointedBodiesAreCounted) {
    Heap heap(short_pile());
    heap.world.step(kStep);
    EXPECT_EQ(heap.stats().mirror_steps, 0u);
    const dReal* x = dBodyGetPosition(heap.bodies.rigid[0]);
    dVector3 center;
    dSoftBodyGetCenterOfMass(heap.bodies.soft[0], center);
    dBodySetPosition(heap.bodies.rigid[0], center[0], center[1], center[2] + 0.12);
    const dJointID hinge = dJointCreateHinge(heap.world.ode(), nullptr);
    dJointAttach(hinge, heap.bodies.rigid[0], nullptr);
    dJointSetHingeAnchor(hinge, x[0], x[1], x[2]);
    dJointSetHingeAxis(hinge, 1, 0, 0);
    heap.world.step(kStep);
    EXPECT_GT(heap.stats().mirror_steps, 0u);
    EXPECT_GE(heap.stats().body_substeps, 12 * heap.stats().substeps);
}

TEST(Pile, SleepIsRefusedWhereItCant) {
    Heap heap(short_pile());
    EXPECT_EQ(dSoftBodyGetAutoDisableFlag(heap.bodies.soft[0]), 0) << "as ODE's own default";
    const int node = 0;
    ASSERT_EQ(dSoftBodyAttachNodes(heap.bodies.soft[0], heap.bodies.rigid[0], &node, 1), 1);
    EXPECT_EQ(dSoftBodyDisable(heap.bodies.soft[0]), 0);
    EXPECT_EQ(dSoftBodyIsEnabled(heap.bodies.soft[0]), 1);
    dSoftRest rest = dSoftRestDefault();
    rest.speed = -1;
    EXPECT_EQ(dSoftBodySetRest(heap.bodies.soft[0], &rest), 0);
    EXPECT_EQ(dSoftBodyDisable(heap.bodies.soft[1]), 1);
    EXPECT_EQ(dSoftBodyIsEnabled(heap.bodies.soft[1]), 0);
    EXPECT_EQ(dSoftBodyEnable(heap.bodies.soft[1]), 1);
    EXPECT_EQ(dSoftBodyIsEnabled(heap.bodies.soft[1]), 1);
}

} // namespace
