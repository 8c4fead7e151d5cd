// An ODE application gets soft bodies without a change to its loop: link order does the rest.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace ode::soft;
using ode::test::OdeApp;

constexpr dReal kStep = 1.0 / 240; // [s]

/// Soft enough for a few hundred substeps a step.
dSoftSolid rubber() {
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = 1e6;
    solid.poisson = 0.3;
    solid.density = 1000;
    solid.alpha = 0;
    solid.beta = 0;
    return solid;
}

struct SoftApp : OdeApp {
    explicit SoftApp(dReal gravity_z = 0)
        : OdeApp(gravity_z), soft(dSoftWorldCreate(world, space)) {}

    dSoftBodyID add_cube(dReal side, dReal z, const dSoftSolid& solid = rubber()) {
        MeshHandle mesh(dSoftMeshCreateBox(side, side, side, 3, 3, 3));
        dSoftBodyID body = dSoftBodyCreate(soft, mesh, &solid);
        dSoftBodySetPosition(body, 0, 0, z);
        return body;
    }

    dReal height(dSoftBodyID body) const {
        dVector3 center;
        dSoftBodyGetCenterOfMass(body, center);
        return center[2];
    }

    WorldHandle soft;
};

dSoftWorldStats stats_of(dSoftWorldID world) {
    dSoftWorldStats stats{};
    stats.struct_size = sizeof stats;
    dSoftWorldGetStats(world, &stats);
    return stats;
}

TEST(SoftWorld, HookIsFoundByLinkOrder) {
    SoftApp app;
    EXPECT_EQ(dSoftWorldGetHook(app.soft), dSoftHookInterposed);
    app.step(kStep);
    EXPECT_EQ(stats_of(app.soft).steps, 1u);
    EXPECT_DOUBLE_EQ(dSoftWorldGetTime(app.soft), kStep);
}

// x'' = g: central difference is exact for constant force, up to its half-step velocity.
TEST(SoftWorld, FreeFallIsExact) {
    SoftApp app(-9.81);
    dSoftBodyID cube = app.add_cube(0.1, 100);
    constexpr int kSteps = 24;
    for (int i = 0; i < kSteps; ++i)
        app.step(kStep);
    const double t = kSteps * kStep;
    const double lag = 9.81 * t * dSoftBodyGetSubstep(cube); // velocity starts on the whole step
    EXPECT_NEAR(app.height(cube), 100 - 9.81 * t * t / 2, lag);
}

TEST(SoftWorld, CubeBouncesOnAPlaneThatTheCallbackNeverPairsWithIt) {
    SoftApp app(-9.81);
    dCreatePlane(app.space, 0, 0, 1, 0);
    dSoftBodyID cube = app.add_cube(0.1, 0.3);
    double lowest = 1;
    double highest_after = 0;
    for (int i = 0; i < 120; ++i) {
        app.step(kStep);
        const double z = app.height(cube);
        if (z < lowest)
            lowest = z, highest_after = z;
        highest_after = std::max(highest_after, z);
    }
    EXPECT_EQ(app.pairs_seen, 0);
    EXPECT_GT(lowest, 0.03); // the undamped cube flattens, but does not sink through
    EXPECT_LT(lowest, 0.05);
    EXPECT_GT(highest_after, 0.1);
    EXPECT_LT(highest_after, 0.3); // what it keeps as vibration it lacks in height
    EXPECT_GT(stats_of(app.soft).contact_points, 0u);
}

// Nothing damps: what height and speed the cube lacks after the bounce, it has as vibration. Impact
// at 0.07 of the wave speed strains it by 20 %, so that the substep must follow on the way.
TEST(SoftWorld, ABounceKeepsEnergyAtAnySubstep) {
    for (const double share : {0.9, 0.45, 0.2}) {
        SoftApp app(-9.81);
        dCreatePlane(app.space, 0, 0, 1, 0);
        dSoftBodyID cube = app.add_cube(0.1, 0.3);
        dSoftBodySetSubstep(cube, share * dSoftBodyGetCriticalStep(cube));
        dSoftContact contact = dSoftContactDefault();
        contact.friction = 0;
        contact.damping = 0;
        dSoftBodySetContact(cube, &contact);
        const double weight = 9.81 * dSoftBodyGetMass(cube);
        const double before = weight * app.height(cube);
        double sum =
            0; // a mean over the flight: one look sees speed and strain half a substep apart
        int looks = 0;
        for (int i = 0; i < 110; ++i) {
            app.step(kStep);
            if (i < 65)
                continue;
            const dSoftEnergy energy = dSoftBodyGetEnergy(cube);
            sum += energy.kinetic + energy.elastic + weight * app.height(cube);
            ++looks;
        }
        const double change = sum / looks / before - 1;
        std::printf("%.2f of the critical step: energy %+.2f %%\n", share, 100 * change);
        EXPECT_LT(std::abs(change), 0.01) << share; // the mark of polyhedral contact
    }
}

// Dropped by 2 mm, a ball rocks and comes to rest: of
// jelly, dented by its weight so far that the mesh is the spring (it stands on its nodes), and
// firmer (it stands on its pole, whose pressure runs ahead of it). Nothing drives it: its energy
// never exceeds what it fell with.
TEST(SoftWorld, ASoftBallSettlesWhereItFell) {
    struct Case {
        dReal young;
        int refinement;
        double seconds;
    };
    for (const Case& c : {Case{1e5, 2, 10}, {1e5, 3, 10}, {1e6, 2, 26}}) {
        SoftApp app(-9.81);
        dCreatePlane(app.space, 0, 0, 1, 0);
        dSoftSolid jelly = rubber();
        jelly.young = c.young;
        jelly.density = 500;
        jelly.beta = 2e-3;
        const MeshHandle mesh(dSoftMeshCreateSphere(0.05, c.refinement));
        const dSoftBodyID ball = dSoftBodyCreate(app.soft, mesh, &jelly);
        dSoftBodySetMaterialModel(ball, "stable-neo-hookean");
        dSoftBodySetPosition(ball, 0, 0, 0.052);
        const dQuaternion turn{0.8, 0.36, 0.48, 0};
        dSoftBodyRotate(ball, turn);
        const double weight = 9.81 * dSoftBodyGetMass(ball);
        double most = 0;
        for (int n = 0; n < c.seconds / kStep; ++n) {
            app.step(kStep);
            const dSoftEnergy energy = dSoftBodyGetEnergy(ball);
            most = std::max(most,
                            energy.kinetic + energy.elastic + weight * (app.height(ball) - 0.05));
        }
        dVector3 linear, angular;
        dSoftBodyGetMomentum(ball, linear, angular);
        const double speed = std::hypot(linear[0], linear[1], linear[2]) / dSoftBodyGetMass(ball);
        std::printf("%.1g Pa, %d: %.2g m/s after %.0f s, energy at most %.4f of the fall's\n",
                    c.young, c.refinement, speed, c.seconds, most / (weight * 0.002));
        EXPECT_LT(speed, 2e-3) << c.young << ' ' << c.refinement;
        EXPECT_LT(most, 1.01 * weight * 0.002) << c.young << ' ' << c.refinement;
        dSoftBodySetAutoDisableFlag(ball, 1);
        for (int n = 0; n < 10 / kStep && dSoftBodyIsEnabled(ball); ++n)
            app.step(kStep);
        EXPECT_FALSE(dSoftBodyIsEnabled(ball)) << c.young << ' ' << c.refinement;
    }
}

// Same world, no dSpaceCollide at all.
TEST(SoftWorld, BodiesCollideEvenWhenTheApplicationForgetsTo) {
    SoftApp app(-9.81);
    dCreatePlane(app.space, 0, 0, 1, 0);
    dSoftBodyID cube = app.add_cube(0.1, 0.15);
    for (int i = 0; i < 60; ++i)
        dWorldStep(app.world, kStep);
    EXPECT_GT(app.height(cube), 0.03);
}

// Momentum lost by one is gained by the other, to rounding.
TEST(SoftWorld, ImpactOnAFreeSphereConservesMomentum) {
    SoftApp app;
    dSoftBodyID cube = app.add_cube(0.1, 0);
    dBodyID ball = app.add_sphere(0.03, 0.5, 0.1);
    dBodySetPosition(ball, 0.011, 0.007, 0.1); // off centre, so that both turn
    dBodySetLinearVel(ball, 0, 0, -2);
    const auto total = [&] {
        dVector3 p, l;
        dSoftBodyGetMomentum(cube, p, l);
        const dReal* v = dBodyGetLinearVel(ball);
        return std::vector<double>{p[0] + 0.5 * v[0], p[1] + 0.5 * v[1], p[2] + 0.5 * v[2]};
    };
    const std::vector<double> before = total();
    for (int i = 0; i < 24; ++i)
        app.step(kStep);
    const std::vector<double> after = total();
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(after[axis], before[axis], 1e-12) << axis; // 1 kg m/s changes hands
    EXPECT_GT(dBodyGetLinearVel(ball)[2], -1.5) << "the ball was never stopped";
}

TEST(SoftWorld, WithoutObserverNoViewIsHandedOut) {
    SoftApp app;
    app.add_cube(0.1, 0);
    app.step(kStep);
    EXPECT_GT(stats_of(app.soft).substeps, 0u);
    EXPECT_EQ(stats_of(app.soft).observer_calls, 0u);
}

TEST(SoftWorld, ObserverSeesEverySubstepOnceAndInOrder) {
    SoftApp app;
    dSoftBodyID cube = app.add_cube(0.1, 0);
    struct Seen {
        std::vector<double> time;
        dSoftBodyID body = nullptr;
    } seen;
    dSoftWorldAddSubstepObserver(
        app.soft,
        [](void* data, const dSoftSubstep* s) {
            auto& all = *static_cast<Seen*>(data);
            all.time.push_back(s->time);
            all.body = s->body;
        },
        &seen);
    app.step(kStep);
    EXPECT_EQ(seen.body, cube);
    EXPECT_EQ(seen.time.size(), stats_of(app.soft).substeps);
    EXPECT_TRUE(std::is_sorted(seen.time.begin(), seen.time.end()));
    EXPECT_NEAR(seen.time.back(), kStep, 1e-15);
    EXPECT_EQ(dSoftWorldRemoveObserver(app.soft, &seen), 1);
    const std::size_t before = seen.time.size();
    app.step(kStep);
    EXPECT_EQ(seen.time.size(), before);
}

std::string heard;
void hear(int, const char* text, va_list arguments) {
    char line[512];
    std::vsnprintf(line, sizeof line, text, arguments);
    heard = line;
}

TEST(SoftWorld, ImpossibleStepsAreRefusedWithASentence) {
    SoftApp app;
    app.add_cube(0.1, 0);
    dSetMessageHandler(hear);
    for (const double h : {0.0, -0.01, std::nan("")}) {
        heard.clear();
        EXPECT_EQ(dSoftWorldStep(app.soft, h, dWorldQuickStep), 0);
        EXPECT_NE(heard.find("step"), std::string::npos) << h;
    }
    dSetMessageHandler(nullptr);
    EXPECT_EQ(dSoftWorldGetTime(app.soft), 0);
}

// An unstable body is told of and left standing; rigid bodies move on as if it weren't there.
TEST(SoftWorld, UnstableBodyIsStoppedAndTheRestGoesOn) {
    SoftApp app(-9.81);
    dSoftBodyID cube = app.add_cube(0.1, 5);
    dBodyID ball = app.add_sphere(0.05, 1, 10);
    dSetMessageHandler(hear);
    heard.clear();
    // A blow that no explicit step at the rest state's size survives.
    dSoftBodyAddForceAtNode(cube, 0, 1e9, 0, 0);
    for (int i = 0; i < 3; ++i)
        app.step(kStep);
    dSetMessageHandler(nullptr);
    dSoftStatus status{};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(cube, &status);
    EXPECT_TRUE(status.stopped);
    EXPECT_NE(heard.find("unstable"), std::string::npos) << heard;
    EXPECT_TRUE(std::isfinite(app.height(cube)));
    EXPECT_LT(dBodyGetPosition(ball)[2], 10);
}

TEST(SoftWorld, EndsInAnyOrder) {
    {
        SoftApp app;
        dSoftBodyID cube = app.add_cube(0.1, 0);
        dSoftBodyDestroy(cube);
        app.step(kStep);
    }
    {
        SoftApp app;
        dSoftBodyID cube = app.add_cube(0.1, 0);
        dGeomDestroy(dSoftBodyGetGeom(cube)); // warned against, yet it must not crash
        app.step(kStep);
        EXPECT_EQ(dSoftBodyGetGeom(cube), nullptr);
    }
    {
        SoftApp app;
        app.add_cube(0.1, 0);
        app.soft.reset();
        app.step(kStep);
    }
    {
        dInitODE2(0);
        dWorldID world = dWorldCreate();
        dSpaceID space = dSimpleSpaceCreate(nullptr);
        dSoftWorldID soft = dSoftWorldCreate(world, space);
        MeshHandle mesh(dSoftMeshCreateBox(1, 1, 1, 1, 1, 1));
        const dSoftSolid solid = rubber();
        ASSERT_NE(dSoftBodyCreate(soft, mesh, &solid), nullptr);
        dWorldDestroy(world); // takes the soft world along
        dSpaceDestroy(space);
        dCloseODE();
    }
}

} // namespace
