// Rigid bodies that lie on a soft one fall asleep under ODE's own rules, and wake together.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace ode::soft;

/// A rubber plate held at its rim, and what lies on it. Bodies sleep after 0.2 s below 1 cm/s.
class Asleep : public testing::Test {
protected:
    Asleep() : app(-9.81), soft(dSoftWorldCreate(app.world, app.space)) {
        dWorldSetAutoDisableFlag(app.world, 1);
        dWorldSetAutoDisableLinearThreshold(app.world, 0.01);
        dWorldSetAutoDisableAngularThreshold(app.world, 0.05);
        dWorldSetAutoDisableSteps(app.world, 0);
        dWorldSetAutoDisableTime(app.world, 0.2);
        dSoftSolid solid = dSoftSolidDefault();
        solid.young = 5e6;
        solid.density = 1000;
        solid.alpha = 100;
        solid.beta = 1e-4;
        const MeshHandle mesh(dSoftMeshCreateBox(0.3, 0.2, 0.03, 9, 6, 1));
        plate = dSoftBodyCreate(soft, mesh, &solid);
        dSoftBodySetPosition(plate, 0, 0, -0.015);
        std::vector<int> rim;
        const dReal* first = nullptr;
        int stride = 0;
        nodes = dSoftBodyGetPositions(plate, &first, &stride);
        for (int i = 0; i < nodes; ++i)
            if (std::fabs(first[i * stride]) > 0.149)
                rim.push_back(i);
        dSoftBodyPinNodes(plate, rim.data(), static_cast<int>(rim.size()));
    }

    dBodyID add_box(dReal side, dReal mass, dReal x, dReal bottom) {
        const dBodyID body = dBodyCreate(app.world);
        dMass m;
        dMassSetBoxTotal(&m, mass, side, side, side);
        dBodySetMass(body, &m);
        dBodySetPosition(body, x, 0, bottom + side / 2);
        dGeomSetBody(dCreateBox(app.space, side, side, side), body);
        return body;
    }
    void run(double seconds) {
        for (double t = 0; t < seconds; t += kStep)
            app.step(kStep);
    }
    static bool asleep(dBodyID body) { return !dBodyIsEnabled(body); }
    static dReal height(dBodyID body) { return dBodyGetPosition(body)[2]; }

    static constexpr double kStep = 0.005;
    ode::test::OdeApp app;
    WorldHandle soft;
    dSoftBodyID plate;
    int nodes = 0;
};

TEST_F(Asleep, APileSleepsAndStaysWhereItIs) {
    const dBodyID low = add_box(0.06, 0.3, 0.02, 0.0005);
    const dBodyID high = add_box(0.04, 0.1, 0.02, 0.061);
    run(12);
    ASSERT_TRUE(asleep(low));
    ASSERT_TRUE(asleep(high));
    const dReal before[] = {height(low), height(high)};
    EXPECT_NEAR(before[1] - before[0], 0.05, 5e-4); // still on top
    run(1);
    EXPECT_TRUE(asleep(low));
    EXPECT_TRUE(asleep(high));
    EXPECT_EQ(height(low), before[0]);
    EXPECT_EQ(height(high), before[1]);
}

TEST_F(Asleep, APileIsWokenWholeByItsSoftBody) {
    const dBodyID low = add_box(0.06, 0.3, 0.02, 0.0005);
    const dBodyID high = add_box(0.04, 0.1, 0.02, 0.061);
    run(12);
    ASSERT_TRUE(asleep(low) && asleep(high));
    const dReal before = height(high);
    bool low_woke = false;
    bool high_woke = false;
    dReal highest = before;
    for (int i = 0; i < 40; ++i) {
        if (i < 2) // 200 N a step on the middle of the plate, from below
            for (int n = 0; n < nodes; ++n)
                dSoftBodyAddForceAtNode(plate, n, 0, 0, 200.0 / nodes);
        app.step(kStep);
        low_woke |= !asleep(low);
        high_woke |= !asleep(high);
        highest = std::fmax(highest, height(high));
    }
    EXPECT_TRUE(low_woke);
    EXPECT_TRUE(high_woke);
    EXPECT_GT(highest, before + 1e-4); // it was thrown, not only enabled
    run(12);
    EXPECT_TRUE(asleep(low) && asleep(high));
}

TEST_F(Asleep, APileIsWokenWholeByABallThatFallsOnIt) {
    const dBodyID low = add_box(0.06, 0.3, 0.02, 0.0005);
    const dBodyID high = add_box(0.04, 0.1, 0.02, 0.061);
    run(12);
    ASSERT_TRUE(asleep(low) && asleep(high));
    const dBodyID ball = app.add_sphere(0.02, 0.5, 0.2);
    dBodySetPosition(ball, 0.02, 0, 0.14);
    const dReal before = height(low);
    dReal lowest = before;
    for (int i = 0; i < 40; ++i) {
        app.step(kStep);
        lowest = std::fmin(lowest, height(low));
    }
    EXPECT_FALSE(asleep(low));
    EXPECT_LT(lowest, before - 1e-4); // the plate bends under the blow
    EXPECT_GT(height(low), -0.02);    // nothing has fallen through
}

// A box at rest reads as at rest, not as g h / 2, jointed or not.
TEST_F(Asleep, WhatRestsReadsNoVelocity) {
    for (const bool jointed : {false, true}) {
        const dReal x = jointed ? 0.05 : -0.05;
        const dBodyID box = add_box(0.05, 0.3, x, 0.0005);
        if (jointed) {
            const dJointID slider = dJointCreateSlider(app.world, nullptr);
            dJointAttach(slider, box, nullptr);
            dJointSetSliderAxis(slider, 0, 0, 1);
        }
        dBodySetAutoDisableFlag(box, 0);
        run(2);
        EXPECT_LT(std::fabs(dBodyGetLinearVel(box)[2]), 1e-4) << jointed;
    }
}

// Two boxes on one plate, apart from each other, joined by a hinge: the blow on one wakes both.
TEST_F(Asleep, AJointedPairIsWokenWhole) {
    const dBodyID left = add_box(0.05, 0.3, -0.04, 0.0005);
    const dBodyID right = add_box(0.05, 0.3, 0.04, 0.0005);
    const dJointID hinge = dJointCreateHinge(app.world, nullptr);
    dJointAttach(hinge, left, right);
    dJointSetHingeAnchor(hinge, 0, 0, 0.025);
    dJointSetHingeAxis(hinge, 0, 1, 0);
    run(4);
    ASSERT_TRUE(asleep(left));
    ASSERT_TRUE(asleep(right));
    const dReal before[] = {height(left), height(right)};
    run(0.5);
    EXPECT_EQ(height(left), before[0]);
    EXPECT_EQ(height(right), before[1]);
    const dBodyID ball = app.add_sphere(0.02, 0.5, 0.2);
    dBodySetPosition(ball, -0.05, 0, 0.12);
    bool right_woke = false;
    for (int i = 0; i < 60; ++i) {
        app.step(kStep);
        right_woke |= !asleep(right);
    }
    EXPECT_TRUE(right_woke);
    EXPECT_GT(height(right), -0.02);
}

// What pressed on the sleepers isn't hoarded till they wake.
TEST_F(Asleep, WakingReleasesNoHoardedForce) {
    const dBodyID low = add_box(0.06, 0.3, 0.02, 0.0005);
    const dBodyID high = add_box(0.04, 0.1, 0.02, 0.061);
    run(12);
    ASSERT_TRUE(asleep(low) && asleep(high));
    dBodyEnable(low);
    dBodyEnable(high);
    double fastest = 0;
    for (int i = 0; i < 20; ++i) {
        app.step(kStep);
        fastest = std::fmax(fastest, std::fabs(dBodyGetLinearVel(high)[2]));
    }
    // Springs within the pile begin without force: for a step the low box may lack the high one's
    // load.
    EXPECT_LT(fastest, 0.1 / 0.3 * 9.81 * kStep);
}

} // namespace
