#include "couple/clone_joint.h"
#include "couple/joint_frame.h"
#include "couple/twin_state.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <functional>
#include <random>

namespace ode::soft {
namespace {

/// A joint of each kind, made with the bodies in one pose.
struct Kind {
    const char* name;
    std::function<dJointID(dWorldID)> create;
    std::function<void(dJointID)> set;
    bool two_bodies = false; ///< it can't be attached to the world
    bool stays = false;      ///< ODE's own gears assert when their bodies turn freely
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {"ball", [](dWorldID w) { return dJointCreateBall(w, nullptr); },
         [](dJointID j) {
             dJointSetBallAnchor(j, 0.1, 0.2, 0.3);
             dJointSetBallParam(j, dParamERP, 0.7);
             dJointSetBallParam(j, dParamCFM, 1e-4);
         }},
        {"hinge", [](dWorldID w) { return dJointCreateHinge(w, nullptr); },
         [](dJointID j) {
             dJointSetHingeAnchor(j, 0.1, 0.2, 0.3);
             dJointSetHingeAxis(j, 1, 2, 3);
             dJointSetHingeParam(j, dParamLoStop, -0.5);
             dJointSetHingeParam(j, dParamHiStop, 0.9);
             dJointSetHingeParam(j, dParamFMax, 3);
             dJointSetHingeParam(j, dParamVel, -2);
         }},
        {"slider", [](dWorldID w) { return dJointCreateSlider(w, nullptr); },
         [](dJointID j) {
             dJointSetSliderAxis(j, 1, 2, 3);
             dJointSetSliderParam(j, dParamHiStop, 0.2);
             dJointSetSliderParam(j, dParamStopERP, 0.4);
             dJointSetSliderParam(j, dParamStopCFM, 1e-3);
         }},
        {"universal", [](dWorldID w) { return dJointCreateUniversal(w, nullptr); },
         [](dJointID j) {
             dJointSetUniversalAnchor(j, 0.1, 0.2, 0.3);
             dJointSetUniversalAxis1(j, 1, 2, 0);
             dJointSetUniversalAxis2(j, 2, -1, 0);
             dJointSetUniversalParam(j, dParamFMax2, 4);
         }},
        {"hinge2", [](dWorldID w) { return dJointCreateHinge2(w, nullptr); },
         [](dJointID j) {
             dJointSetHinge2Anchor(j, 0.1, 0.2, 0.3);
             const dVector3 one{0, 0.6, 0.8};
             const dVector3 two{1, 0, 0};
             dJointSetHinge2Axes(j, one, two);
             dJointSetHinge2Param(j, dParamSuspensionERP, 0.5);
             dJointSetHinge2Param(j, dParamSuspensionCFM, 1e-3);
         },
         true},
        {"PR", [](dWorldID w) { return dJointCreatePR(w, nullptr); },
         [](dJointID j) {
             dJointSetPRAnchor(j, 0.1, 0.2, 0.3);
             dJointSetPRAxis1(j, 1, 0, 0);
             dJointSetPRAxis2(j, 0, 0, 1);
         }},
        {"PU", [](dWorldID w) { return dJointCreatePU(w, nullptr); },
         [](dJointID j) {
             dJointSetPUAnchor(j, 0.1, 0.2, 0.3);
             dJointSetPUAxis1(j, 0, 1, 0);
             dJointSetPUAxis2(j, 0, 0, 1);
             dJointSetPUAxis3(j, 1, 0, 0);
         }},
        {"piston", [](dWorldID w) { return dJointCreatePiston(w, nullptr); },
         [](dJointID j) {
             dJointSetPistonAnchor(j, 0.1, 0.2, 0.3);
             dJointSetPistonAxis(j, 1, 2, 3);
         }},
        {"fixed", [](dWorldID w) { return dJointCreateFixed(w, nullptr); },
         [](dJointID j) { dJointSetFixed(j); }},
        {"euler motor", [](dWorldID w) { return dJointCreateAMotor(w, nullptr); },
         [](dJointID j) {
             dJointSetAMotorMode(j, dAMotorEuler);
             dJointSetAMotorAxis(j, 0, 1, 1, 0, 0);
             dJointSetAMotorAxis(j, 2, 2, 0, 0, 1);
             dJointSetAMotorParam(j, dParamLoStop3, -0.3);
         },
         true},
        {"angular motor", [](dWorldID w) { return dJointCreateAMotor(w, nullptr); },
         [](dJointID j) {
             dJointSetAMotorNumAxes(j, 2);
             dJointSetAMotorAxis(j, 0, 0, 1, 0, 0);
             dJointSetAMotorAxis(j, 1, 1, 0, 1, 1);
             dJointSetAMotorAngle(j, 1, 0.4);
         }},
        {"linear motor", [](dWorldID w) { return dJointCreateLMotor(w, nullptr); },
         [](dJointID j) {
             dJointSetLMotorNumAxes(j, 1);
             dJointSetLMotorAxis(j, 0, 0, 0, 1, 1);
             dJointSetLMotorParam(j, dParamVel, 2);
             dJointSetLMotorParam(j, dParamFMax, 20);
         }},
        {"plane2d", [](dWorldID w) { return dJointCreatePlane2D(w, nullptr); }, [](dJointID) {}},
        {"double ball", [](dWorldID w) { return dJointCreateDBall(w, nullptr); },
         [](dJointID j) {
             dJointSetDBallAnchor1(j, 0.1, 0.2, 0.3);
             dJointSetDBallAnchor2(j, 0.5, 0.2, 0.3);
         }},
        {"double hinge", [](dWorldID w) { return dJointCreateDHinge(w, nullptr); },
         [](dJointID j) {
             dJointSetDHingeAxis(j, 0, 1, 0);
             dJointSetDHingeAnchor1(j, 0.1, 0.2, 0.3);
             dJointSetDHingeAnchor2(j, 0.5, 0.2, 0.3);
         }},
        {"gears", [](dWorldID w) { return dJointCreateTransmission(w, nullptr); },
         [](dJointID j) {
             dJointSetTransmissionMode(j, dTransmissionParallelAxes);
             dJointSetTransmissionAnchor1(j, 0, 0, 0);
             dJointSetTransmissionAnchor2(j, 0.5, 0, 0);
             dJointSetTransmissionAxis(j, 0, 1, 0);
             dJointSetTransmissionRatio(j, 1.5);
         },
         true, true},
    };
    return all;
}

/// One world with a joint that has been moved away from where it was made by its own freedom: a few
/// steps of ODE under a kick.
struct Scene {
    Scene(const Kind& kind, int order) : world(dWorldCreate()) {
        dWorldSetGravity(world, 0, 0, -3);
        dMass m;
        dMassSetBoxTotal(&m, 1, 0.3, 0.2, 0.1);
        for (int i = 0; i < 2; ++i) {
            body[i] = dBodyCreate(world);
            dBodySetMass(body[i], &m);
            dBodySetPosition(body[i], 0.5 * i, 0, 0);
            dBodySetFiniteRotationMode(body[i], 1);
            dBodySetGravityMode(body[i], i); // something must pull them apart
        }
        joint = kind.create(world);
        const dBodyID none = nullptr;
        first = order == 1 ? none : body[0];
        second = order == 0 ? none : order == 1 ? body[0] : body[1];
        dJointAttach(joint, first, second);
        kind.set(joint);
    }
    ~Scene() { dWorldDestroy(world); }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    void run(int steps) {
        for (int i = 0; i < steps; ++i) {
            dBodyAddTorque(body[0], 0.07, 0.1, 0.04);
            dBodyAddForce(body[0], 0.1, 0.05, 0.02);
            dWorldStep(world, 1e-4);
        }
    }

    dWorldID world;
    dBodyID body[2];
    dBodyID first;
    dBodyID second;
    dJointID joint;
};

class CloneJoint : public testing::TestWithParam<std::size_t> {
protected:
    static void SetUpTestSuite() { dInitODE2(0); }
    static void TearDownTestSuite() { dCloseODE(); }
};

// Cloned in the middle of its motion, the twin says of itself what the joint says, and moves on as
// it does: attached to the world, from the world, and between two bodies.
TEST_P(CloneJoint, TwinIsAndMovesAsTheJoint) {
    const Kind& kind = kinds()[GetParam()];
    for (const int order : {0, 1, 2}) {
        if ((kind.two_bodies && order != 2) || (order == 1 && kind.name == std::string("PU")))
            continue; // see copy_geometry()
        SCOPED_TRACE(std::string(kind.name) + ", order " + std::to_string(order));
        Scene app(kind, order);
        if (!kind.stays)
            app.run(3000);
        const dWorldID world = dWorldCreate();
        dWorldSetGravity(world, 0, 0, -3);
        dBodyID twin[2];
        for (int i = 0; i < 2; ++i) {
            twin[i] = dBodyCreate(world);
            dMass m;
            dBodyGetMass(app.body[i], &m);
            dBodySetMass(twin[i], &m);
            TwinState(app.body[i]).apply(twin[i]);
            dBodySetFiniteRotationMode(twin[i], 1);
            dBodySetGravityMode(twin[i], i);
        }
        const auto twin_of = [&](dBodyID b) {
            return !b ? b : b == app.body[0] ? twin[0] : twin[1];
        };
        const dJointID joint =
            create_twin(world, app.joint, twin_of(app.first), twin_of(app.second));
        ASSERT_NE(joint, nullptr);
        copy_geometry(app.joint, joint);
        copy_parameters(app.joint, joint, Softness{1});
        const bool euler = kind.name == std::string("euler motor"); // stood in for, step by step
        EXPECT_EQ(same_geometry(app.joint, joint), !euler)
            << distance(read_frame(app.joint), read_frame(joint));
        for (int i = 0; i < (kind.stays ? 0 : 100); ++i) {
            for (const dBodyID b : {app.body[0], twin[0]})
                dBodyAddTorque(b, 0.07, 0.1, 0.04);
            dWorldStep(app.world, 1e-4);
            dWorldStep(world, 1e-4);
        }
        // ODE's own PR and piston joints blow up when attached as (0, body).
        const bool violent = TwinState(app.body[0]).twist().norm() > 100;
        EXPECT_EQ(violent, order == 1 && (kind.name == std::string("PR") ||
                                          kind.name == std::string("piston")));
        for (int i = 0; i < (violent ? 0 : 2); ++i) {
            const Vec6 v = TwinState(twin[i]).twist() - TwinState(app.body[i]).twist();
            // What can't be asked, the joint's own misalignment, is corrected at another pace.
            EXPECT_LT(v.norm(), 2e-3 * (1 + TwinState(app.body[i]).twist().norm()));
            const dReal* x = dBodyGetPosition(twin[i]);
            const dReal* y = dBodyGetPosition(app.body[i]);
            EXPECT_LT(std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]),
                      kind.name == std::string("PU") ? 1e-4 : 1e-5);
        }
        dWorldDestroy(world);
    }
}
INSTANTIATE_TEST_SUITE_P(Kinds, CloneJoint, testing::Range<std::size_t>(0, 16));

// ODE's pair is a spring and a damper: a mass on a soft ball joint swings alike at any step.
TEST(Softness, KeepsSpringAndDamper) {
    const double h = 5e-3;
    const double erp = 0.3;
    const double cfm = 2e-3;
    const double k = erp / (h * cfm);
    const double c = (1 - erp) / cfm;
    for (const double ratio : {1.0, 0.1, 1e-3}) {
        const double e = Softness{ratio}.erp(erp);
        const double f = Softness{ratio}.cfm(erp, cfm);
        EXPECT_NEAR(e / (ratio * h * f), k, 1e-12 * k);
        EXPECT_NEAR((1 - e) / f, c, 1e-12 * c);
    }
}

} // namespace
} // namespace ode::soft
