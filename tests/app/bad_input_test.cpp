// Whatever an application gets wrong ends in one sentence per cause, never in a crash.
#include "support/soft_app.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace ode::soft;
using namespace ode::test;

constexpr dReal kStep = 1.0 / 240; // [s]
constexpr dReal kNan = std::numeric_limits<dReal>::quiet_NaN();

struct BadInput : testing::Test, OdeApp {
    BadInput() : OdeApp(-9.81), soft(dSoftWorldCreate(world, space)) {}
    void steps(int count) {
        for (int i = 0; i < count; ++i)
            step(kStep);
    }
    dSoftWorldID soft;
    Messages messages;
};

TEST_F(BadInput, DestroyedIds) {
    dSoftBodyID cube = add_cube(soft, 0.1, 1);
    dSoftBodyDestroy(cube);
    const dSoftBodyID other = add_cube(soft, 0.1, 1); // may take the same memory
    const dReal* first = nullptr;
    int stride = 0;
    EXPECT_EQ(dSoftBodyGetMass(cube), 0);
    EXPECT_EQ(dSoftBodySetPosition(cube, 0, 0, 0), 0);
    EXPECT_EQ(dSoftBodyGetPositions(cube, &first, &stride), 0);
    EXPECT_EQ(dSoftBodyGetGeom(cube), nullptr);
    dSoftBodyDestroy(cube);
    EXPECT_EQ(Messages::with("there is no soft body"), 4) << Messages::text();
    EXPECT_GT(dSoftBodyGetMass(other), 0);

    dSoftMeshID mesh = dSoftMeshCreateBox(1, 1, 1, 1, 1, 1);
    dSoftMeshDestroy(mesh);
    const dSoftSolid solid = soft_rubber();
    EXPECT_EQ(dSoftBodyCreate(soft, mesh, &solid), nullptr);
    EXPECT_EQ(Messages::with("there is no mesh"), 1);

    dSoftWorldDestroy(soft);
    EXPECT_EQ(dSoftWorldGetTime(soft), 0);
    EXPECT_EQ(dSoftBodyGetMass(other), 0);
    dSoftWorldDestroy(soft);
    EXPECT_EQ(Messages::with("there is no soft world"), 1);
}

TEST_F(BadInput, RigidMotionThatIsNotFinite) {
    dCreatePlane(space, 0, 0, 1, 0);
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.05);
    const dBodyID ball = add_sphere(0.05, 1, 0.13);
    dBodySetLinearVel(ball, kNan, 0, 0);
    for (int i = 0; i < 5; ++i) {
        dWorldStep(world, 1e-3);
        dBodySetPosition(ball, 0, 0, 0.13); // else ODE itself trips over the NaN
    }
    EXPECT_EQ(Messages::with("not finite"), 1) << Messages::text();
    EXPECT_TRUE(std::isfinite(height_of(cube)));
    dSoftStatus status{};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(cube, &status);
    EXPECT_FALSE(status.stopped);
    dBodyDestroy(ball);
}

TEST_F(BadInput, RigidPoseThatIsNotFinite) {
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.05);
    const dGeomID box = dCreateBox(space, 1, 1, 1);
    dGeomSetPosition(box, 0, 0, kNan);
    for (int i = 0; i < 5; ++i)
        dWorldStep(world, kStep);
    EXPECT_LE(Messages::with("not finite"), 1) << Messages::text();
    EXPECT_LT(height_of(cube), 0.05);
}

TEST_F(BadInput, SizesOfNothingAndInfinity) {
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.05);
    dGeomSetPosition(dCreateSphere(space, std::numeric_limits<dReal>::infinity()), 0, 0, 0);
    dGeomSetPosition(dCreateBox(space, 1, 1, 0), 0, 0, 0.05);
    dGeomSetPosition(dCreateCapsule(space, 0, 1), 0, 0, 0.05);
    for (int i = 0; i < 10; ++i)
        dWorldStep(world, kStep);
    EXPECT_EQ(Messages::with("size inf m"), 1) << Messages::text();
    EXPECT_EQ(Messages::all().size(), 1u) << "ODE itself passes over geoms without size";
    EXPECT_LT(height_of(cube), 0.05 - 9.81 * 0.03 * 0.03 / 2);
}

TEST_F(BadInput, LockedSpaces) {
    const dSoftBodyID cube = add_cube(soft, 0.1, 1);
    dCreatePlane(space, 0, 0, 1, 0);
    dCreateSphere(space, 1);
    struct Trial {
        dSoftWorldID soft;
        dSoftBodyID cube;
        int calls;
    } trial{soft, cube, 0};
    dSpaceCollide(space, &trial, [](void* data, dGeomID, dGeomID) {
        Trial& t = *static_cast<Trial*>(data);
        ++t.calls;
        EXPECT_EQ(add_cube(t.soft, 0.1, 2), nullptr);
        EXPECT_EQ(dSoftBodySetPosition(t.cube, 0, 0, 3), 0);
        dSoftBodyDestroy(t.cube);
        dSoftWorldDestroy(t.soft);
    });
    ASSERT_EQ(trial.calls, 1);
    EXPECT_EQ(Messages::with("near callback"), 4) << Messages::text();
    EXPECT_NEAR(height_of(cube), 1, 1e-12);
    dSoftBodyDestroy(cube);
    EXPECT_EQ(dSoftBodyGetMass(cube), 0);
}

TEST_F(BadInput, SpacesThatAreGone) {
    const dSpaceID other = dSimpleSpaceCreate(nullptr);
    const dWorldID second = dWorldCreate();
    const dSoftWorldID lost = dSoftWorldCreate(second, other);
    dSpaceDestroy(other);
    EXPECT_EQ(add_cube(lost, 0.1, 1), nullptr);
    EXPECT_EQ(Messages::with("space of the soft world is gone"), 1) << Messages::text();
    dWorldDestroy(second);
}

TEST_F(BadInput, StepsThatAreNone) {
    const dSoftBodyID cube = add_cube(soft, 0.1, 1);
    for (const dReal h :
         {dReal{0}, dReal{-1}, kNan, std::numeric_limits<dReal>::infinity(), dReal{1e6}}) {
        EXPECT_EQ(dWorldStep(world, h), 0) << h;
        EXPECT_EQ(dWorldQuickStep(world, h), 0) << h;
        EXPECT_EQ(dSoftWorldStep(soft, h, dWorldStep), 0) << h;
    }
    EXPECT_EQ(Messages::with("is refused"), 15) << Messages::text();
    EXPECT_EQ(dSoftWorldGetTime(soft), 0);
    EXPECT_NEAR(height_of(cube), 1, 1e-12);
    EXPECT_EQ(dWorldStep(world, kStep), 1);
}

struct Meddler {
    dSoftWorldID soft;
    dSoftBodyID cube;
    int calls = 0;
};

void meddle(void* data, const dSoftSubstep*) {
    Meddler& m = *static_cast<Meddler*>(data);
    if (m.calls++)
        return;
    EXPECT_EQ(add_cube(m.soft, 0.1, 2), nullptr);
    EXPECT_EQ(dSoftBodySetPosition(m.cube, 0, 0, 3), 0);
    dSoftBodyDestroy(m.cube);
    dSoftWorldDestroy(m.soft);
    // Observers may come and go, even this one.
    static int another = 0;
    EXPECT_EQ(dSoftWorldAddSubstepObserver(
                  m.soft, [](void* count, const dSoftSubstep*) { ++*static_cast<int*>(count); },
                  &another),
              1);
    EXPECT_EQ(dSoftWorldRemoveObserver(m.soft, data), 1);
}

TEST_F(BadInput, ObserversThatMeddle) {
    const dSoftBodyID cube = add_cube(soft, 0.1, 1);
    Meddler meddler{soft, cube};
    dSoftWorldAddSubstepObserver(soft, meddle, &meddler);
    steps(2);
    EXPECT_EQ(meddler.calls, 1) << "it had removed itself";
    EXPECT_EQ(Messages::with("within a step"), 4) << Messages::text();
    EXPECT_LT(height_of(cube), 1);
}

TEST_F(BadInput, BodiesThatEndInTheCallbackOfTheirEnd) {
    const dSoftBodyID cube = add_cube(soft, 0.1, 1);
    dSoftObserver observer{};
    observer.struct_size = sizeof observer;
    observer.on_body_end = [](void*, dSoftBodyID body) { dSoftBodyDestroy(body); };
    dSoftWorldAddObserver(soft, &observer);
    dSoftBodyDestroy(cube);
    EXPECT_EQ(Messages::all().size(), 1u) << Messages::text();
    EXPECT_EQ(dSoftBodyGetMass(cube), 0);
}

TEST_F(BadInput, StructsWithoutTheirSize) {
    const dSoftBodyID cube = add_cube(soft, 0.1, 1);
    const dSoftSolid solid{};
    const MeshHandle mesh(dSoftMeshCreateBox(1, 1, 1, 1, 1, 1));
    EXPECT_EQ(dSoftBodyCreate(soft, mesh, &solid), nullptr);
    const dSoftContact contact{};
    EXPECT_EQ(dSoftBodySetContact(cube, &contact), 0);
    const dSoftObserver observer{};
    EXPECT_EQ(dSoftWorldAddObserver(soft, &observer), 0);
    dSoftStatus status{};
    EXPECT_EQ(dSoftBodyGetStatus(cube, &status), 0);
    dSoftWorldStats stats{};
    EXPECT_EQ(dSoftWorldGetStats(soft, &stats), 0);
    EXPECT_EQ(Messages::with("struct_size is 0"), 5) << Messages::text();
}

TEST_F(BadInput, NumbersThatAreNone) {
    const dSoftBodyID cube = add_cube(soft, 0.1, 1);
    const dQuaternion none = {kNan, 0, 0, 0};
    EXPECT_EQ(dSoftBodySetPosition(cube, kNan, 0, 0), 0);
    EXPECT_EQ(dSoftBodySetLinearVel(cube, 0, kNan, 0), 0);
    EXPECT_EQ(dSoftBodyAddAngularVel(cube, 0, 0, kNan), 0);
    EXPECT_EQ(dSoftBodyRotate(cube, none), 0);
    EXPECT_EQ(dSoftBodyAddForceAtNode(cube, 0, kNan, 0, 0), 0);
    EXPECT_EQ(dSoftBodyAddForceAtNode(cube, -1, 0, 0, 0), 0);
    EXPECT_EQ(dSoftBodySetSubstep(cube, kNan), 0);
    EXPECT_EQ(Messages::all().size(), 7u) << Messages::text();
    EXPECT_NEAR(height_of(cube), 1, 1e-12);
}

} // namespace
