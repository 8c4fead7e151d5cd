// The application's own contact parameters, pair by pair; and what ODE decides before we are asked.
#include "support/soft_app.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace ode::soft;
using namespace ode::test;

constexpr dReal kStep = 1.0 / 240; // [s]

struct ContactCallback : testing::Test, OdeApp {
    ContactCallback() : OdeApp(-9.81), soft(dSoftWorldCreate(world, space)) {}
    dSoftWorldID soft;
};

/// What a callback is told and answers.
struct Answer {
    dSoftContact contact = dSoftContactDefault();
    int meets = 1;
    int asked = 0;
    dGeomID soft = nullptr;
    dGeomID rigid = nullptr;
    dReal friction_before = -1;
};

int answer(void* data, dGeomID soft, dGeomID rigid, dSoftContact* contact) {
    Answer& a = *static_cast<Answer*>(data);
    ++a.asked;
    a.soft = soft;
    a.rigid = rigid;
    a.friction_before = contact->friction;
    *contact = a.contact;
    return a.meets;
}

TEST_F(ContactCallback, IsAskedOnceAPairAndStep) {
    const dGeomID floor = dCreatePlane(space, 0, 0, 1, 0);
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.05);
    dSoftContact own = dSoftContactDefault();
    own.friction = 0.25;
    dSoftBodySetContact(cube, &own);
    Answer a;
    dSoftWorldSetContactCallback(soft, answer, &a);
    for (int i = 0; i < 7; ++i)
        step(kStep);
    EXPECT_EQ(a.asked, 7);
    EXPECT_EQ(a.soft, dSoftBodyGetGeom(cube));
    EXPECT_EQ(a.rigid, floor);
    EXPECT_EQ(a.friction_before, 0.25);
    dSoftWorldSetContactCallback(soft, nullptr, nullptr);
    step(kStep);
    EXPECT_EQ(a.asked, 7);
}

TEST_F(ContactCallback, MayRefuseAPair) {
    dCreatePlane(space, 0, 0, 1, 0);
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.05);
    Answer a;
    a.meets = 0;
    dSoftWorldSetContactCallback(soft, answer, &a);
    for (int i = 0; i < 60; ++i)
        step(kStep);
    EXPECT_LT(height_of(cube), -0.1);
}

// Gravity turned by the slope: below the angle of friction the cube sticks, above it slides by
// g (sin - mu cos) t^2 / 2 (Coulomb).
TEST_F(ContactCallback, GivesFriction) {
    const double slope = std::atan(0.5);
    dWorldSetGravity(world, 9.81 * std::sin(slope), 0, -9.81 * std::cos(slope));
    dCreatePlane(space, 0, 0, 1, 0);
    for (const double friction : {0.0, 0.2, 0.7}) {
        dSoftSolid solid = soft_rubber();
        solid.beta = 1e-3; // no bounces
        solid.poisson = 0;
        const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.05, 3, 3, 2));
        const dSoftBodyID cube = dSoftBodyCreate(soft, mesh, &solid);
        dSoftBodySetPosition(cube, 0, 0, 0.025);
        Answer a;
        a.contact.friction = friction;
        dSoftWorldSetContactCallback(soft, answer, &a);
        dVector3 from, to;
        const auto run = [&](int steps) {
            for (int i = 0; i < steps; ++i)
                step(kStep);
        };
        run(24); // settles
        dVector3 p0, p1, l;
        dSoftBodyGetCenterOfMass(cube, from);
        dSoftBodyGetMomentum(cube, p0, l);
        run(48);
        dSoftBodyGetCenterOfMass(cube, to);
        dSoftBodyGetMomentum(cube, p1, l);
        const double t = 48 * kStep;
        const double mass = dSoftBodyGetMass(cube);
        const double wanted = std::max(0.0, 9.81 * (std::sin(slope) - friction * std::cos(slope)));
        const double got = (p1[0] - p0[0]) / mass / t;
        std::printf("friction %.1f: %.3f m/s^2, exact %.3f\n", friction, got, wanted);
        EXPECT_NEAR(got, wanted, 0.02 * 9.81);
        if (wanted == 0) {
            EXPECT_NEAR(to[0], from[0], 1e-3);
        }
        dSoftBodyDestroy(cube);
    }
}

TEST_F(ContactCallback, NonsenseLeavesTheBodysOwnWithOneSentence) {
    const Messages messages;
    dCreatePlane(space, 0, 0, 1, 0);
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.05);
    Answer a;
    a.contact.friction = -1;
    dSoftWorldSetContactCallback(soft, answer, &a);
    for (int i = 0; i < 20; ++i)
        step(kStep);
    EXPECT_EQ(Messages::with("friction -1"), 1) << Messages::text();
    EXPECT_GT(height_of(cube), 0.03);
}

// ODE's own bits and switches come first: such pairs never reach us.
TEST_F(ContactCallback, IsNotAskedAboutPairsThatOdeRulesOut) {
    const dGeomID floor = dCreatePlane(space, 0, 0, 1, 0);
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.05);
    const dGeomID own = dSoftBodyGetGeom(cube);
    Answer a;
    dSoftWorldSetContactCallback(soft, answer, &a);
    const auto asked_in_a_step = [&] {
        a.asked = 0;
        dSoftBodySetPosition(cube, 0, 0, 0.0499);
        step(kStep);
        return a.asked;
    };
    EXPECT_EQ(asked_in_a_step(), 1);
    dGeomSetCategoryBits(floor, 2);
    dGeomSetCollideBits(floor, 2);
    dGeomSetCategoryBits(own, 1);
    dGeomSetCollideBits(own, 1);
    EXPECT_EQ(asked_in_a_step(), 0);
    dGeomSetCollideBits(own, 3); // one of the two suffices
    EXPECT_EQ(asked_in_a_step(), 1);
    dGeomDisable(floor);
    EXPECT_EQ(asked_in_a_step(), 0);
    dGeomEnable(floor);
    dGeomDisable(own);
    EXPECT_EQ(asked_in_a_step(), 0);
    dGeomEnable(own);
    EXPECT_EQ(asked_in_a_step(), 1);
}

} // namespace
