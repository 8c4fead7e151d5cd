#include "couple/rigid_shadow.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cmath>

namespace ode::soft {
namespace {

Vec3 vec(const dReal* v) { return {v[0], v[1], v[2]}; }

class RigidShadowTest : public testing::Test {
protected:
    static void SetUpTestSuite() { dInitODE2(0); }
    static void TearDownTestSuite() { dCloseODE(); }

    RigidShadowTest() : world_(dWorldCreate()) {}
    ~RigidShadowTest() override { dWorldDestroy(world_); }

    dBodyID body(const Vec3& inertia = {0.01, 0.02, 0.025}) {
        const dBodyID b = dBodyCreate(world_);
        dMass mass;
        dMassSetParameters(&mass, 2, 0, 0, 0, inertia.x(), inertia.y(), inertia.z(), 0, 0, 0);
        dBodySetMass(b, &mass);
        return b;
    }

    dWorldID world_;
};

/// Spin energy and angular momentum of a shadow with the given principal inertia.
struct Spin {
    Spin(const RigidShadow& shadow, const Vec3& inertia) {
        const Mat3& r = shadow.motion().pose.rotation;
        const Vec3 local = r.transpose() * shadow.motion().spin;
        energy = local.dot(inertia.asDiagonal() * local) / 2;
        momentum = r * (inertia.asDiagonal() * local);
    }
    double energy;
    Vec3 momentum;
};

// Two seconds of tumbling about the unstable axis at 50 rad/s. The angular momentum is a state, so
// only energy can drift; the midpoint rule makes that second order in the substep.
// research: 1.4e-8, 1.4e-6, 1.3e-4 for another inertia.
TEST_F(RigidShadowTest, TumblesWithoutLosingEnergy) {
    const Vec3 inertia(0.01, 0.02, 0.025);
    double error[3] = {};
    const double dt[3] = {1e-5, 1e-4, 1e-3};
    for (int i = 0; i < 3; ++i) {
        const dBodyID b = body(inertia);
        dBodySetAngularVel(b, 0.05, 50, 0.05);
        RigidShadow shadow(b, 2, dt[i]);
        const Spin start(shadow, inertia);
        for (double t = 0; t < 2; t += dt[i]) {
            shadow.advance(dt[i]);
            const Spin now(shadow, inertia);
            error[i] = std::fmax(error[i], std::fabs(now.energy / start.energy - 1));
            ASSERT_LT((now.momentum - start.momentum).norm(), 1e-13 * start.momentum.norm());
        }
    }
    EXPECT_LT(error[0], 3e-8);
    EXPECT_NEAR(error[1] / error[0], 100, 10);
    EXPECT_NEAR(error[2] / error[1], 100, 10);
}

// A twin under ODE alone: gravity, the application's force, damping. Equal for any number of
// substeps, because the velocity that ODE stores is taken for what it is (see the class).
TEST_F(RigidShadowTest, FliesAsUnderOde) {
    dWorldSetGravity(world_, 0, 0, -9.81);
    for (const int substeps : {1, 7, 100}) {
        const Vec3 round = Vec3::Constant(0.02); // spin axis stays: ODE's finite rotation is exact
        dBodyID twin[2] = {body(round), body(round)};
        for (const dBodyID b : twin) {
            dBodySetLinearVel(b, 1, 2, 3);
            dBodySetAngularVel(b, 4, -5, 6);
            dBodySetLinearDamping(b, 0.01);
            dBodySetAngularDamping(b, 0.02);
            dBodySetFiniteRotationMode(b, 1);
        }
        const double h = 0.005;
        for (int step = 0; step < 100; ++step) {
            for (const dBodyID b : twin)
                dBodyAddForce(b, 3, 0, 1);
            RigidShadow shadow(twin[0], h, h / substeps);
            for (int i = 0; i < substeps; ++i) {
                shadow.add({}); // a contact without force: the result is written back
                shadow.advance(h / substeps);
            }
            shadow.hand_over();
            dWorldStep(world_, h);
            shadow.write_back();
        }
        const auto near = [&](const dReal* (*get)(dBodyID)) {
            // 1e4 additions of numbers up to 10, each rounded to 1e-16 of them
            EXPECT_LT((vec(get(twin[0])) - vec(get(twin[1]))).norm(), 1e-11) << substeps;
        };
        near(&dBodyGetPosition);
        near(&dBodyGetLinearVel);
        near(&dBodyGetAngularVel);
        near(&dBodyGetQuaternion);
    }
}

TEST_F(RigidShadowTest, TakesContactsAsImpulses) {
    const dBodyID b = body();
    const double dt = 1e-4;
    RigidShadow shadow(b, 10 * dt, dt);
    const Vec3 force(1, -2, 0.5);
    const Vec3 torque(0.02, 0.01, -0.03);
    for (int i = 0; i < 10; ++i) {
        shadow.add({force, torque});
        shadow.advance(dt);
    }
    const Spin spin(shadow, {0.01, 0.02, 0.025});
    EXPECT_LT((2 * shadow.motion().velocity - 10 * dt * force).norm(), 1e-16);
    EXPECT_LT((spin.momentum - 10 * dt * torque).norm(), 1e-16);
    EXPECT_LT((shadow.impulse().force - 10 * dt * force).norm(), 1e-17);
}

// compliance() is the velocity change of the point along the normal per impulse along it.
TEST_F(RigidShadowTest, ComplianceIsTheAnswerToAnImpulse) {
    const dBodyID b = body();
    dQuaternion q;
    dQFromAxisAndAngle(q, 1, 2, 3, 0.8);
    dBodySetQuaternion(b, q);
    RigidShadow shadow(b, 1e-9, 1e-9);
    const Vec3 point(0.3, 0.1, -0.2);
    const Vec3 normal = Vec3(1, 1, -0.4).normalized();
    const double expected = shadow.compliance(point, normal);
    shadow.add({1e9 * normal, point.cross(Vec3(1e9 * normal))});
    shadow.advance(1e-9);
    // The pose moves by 1e-8 m meanwhile.
    EXPECT_NEAR(shadow.motion().velocity_at(point).dot(normal), expected, 1e-6 * expected);
}

TEST_F(RigidShadowTest, KinematicBodiesMoveAsPrescribed) {
    const dBodyID b = body();
    dBodySetKinematic(b);
    dBodySetLinearVel(b, 1, 0, 0);
    dBodySetAngularVel(b, 0, 0, 2);
    RigidShadow shadow(b, 0.01, 0.001);
    EXPECT_EQ(shadow.role(), RigidRole::prescribed);
    EXPECT_EQ(shadow.compliance({1, 1, 1}, Vec3::UnitX()), 0);
    for (int i = 0; i < 10; ++i) {
        shadow.add({Vec3(1e6, 1e6, 1e6), Vec3::Zero()});
        shadow.advance(0.001);
    }
    EXPECT_NEAR(shadow.motion().pose.position.x(), 0.01, 1e-15);
    EXPECT_NEAR(shadow.motion().pose.rotation(1, 0), std::sin(0.02), 1e-15);
}

TEST_F(RigidShadowTest, RespectsTheSpinLimitAndTheGyroscopicMode) {
    const dBodyID b = body();
    dBodySetMaxAngularSpeed(b, 3);
    dBodySetAngularVel(b, 0, 10, 0); // a principal axis
    RigidShadow limited(b, 0.01, 0.001);
    limited.advance(0.001);
    EXPECT_LE(limited.motion().spin.norm(), 3 * (1 + 1e-12));

    const dBodyID free = body();
    dBodySetAngularVel(free, 1, 10, 2);
    dBodySetGyroscopicMode(free, 0);
    RigidShadow shadow(free, 0.1, 0.001);
    for (int i = 0; i < 100; ++i)
        shadow.advance(0.001);
    EXPECT_LT((shadow.motion().spin - Vec3(1, 10, 2)).norm(), 1e-12);
}

TEST_F(RigidShadowTest, WakesASleepingBodyOnlyByTouchingIt) {
    dWorldSetGravity(world_, 0, 0, -9.81);
    const dBodyID b = body();
    dBodyDisable(b);
    for (const bool touch : {false, true}) {
        RigidShadow shadow(b, 0.01, 0.001);
        for (int i = 0; i < 10; ++i) {
            if (touch)
                shadow.add({Vec3(0, 0, 40), Vec3::Zero()});
            shadow.advance(0.001);
        }
        shadow.hand_over();
        dWorldStep(world_, 0.01);
        shadow.write_back();
        EXPECT_EQ(dBodyIsEnabled(b), touch);
        EXPECT_EQ(dBodyGetPosition(b)[2] > 0, touch);
    }
}

// A jointed body without a mirror: ODE gets the mean force and keeps the last word on its pose.
TEST_F(RigidShadowTest, GivesUnheardBodiesTheMeanForce) {
    const dBodyID b = body();
    const dJointID slider = dJointCreateSlider(world_, nullptr);
    dJointAttach(slider, b, nullptr);
    dJointSetSliderAxis(slider, 1, 0, 0);
    const double h = 0.01;
    RigidShadow shadow(b, h, h / 10);
    EXPECT_EQ(shadow.role(), RigidRole::unheard);
    for (int i = 0; i < 10; ++i) {
        shadow.add({Vec3(i < 5 ? 4 : 0, 7, 0), Vec3::Zero()});
        shadow.advance(h / 10);
    }
    shadow.hand_over();
    dWorldStep(world_, h);
    shadow.write_back();
    EXPECT_NEAR(dBodyGetLinearVel(b)[0], 2 * h / 2, 1e-6); // mean 2 N on 2 kg; CFM of ODE: 1e-10
    EXPECT_NEAR(dBodyGetLinearVel(b)[1], 0, 1e-6);
}

} // namespace
} // namespace ode::soft
