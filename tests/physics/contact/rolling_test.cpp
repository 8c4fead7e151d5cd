// Balls on a soft plate, through ODE's own step: from sliding or spinning to rolling, and rolling
// down a slope.
#include "physics/contact/soft_app.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace ode::soft {
namespace {

constexpr double kRadius = 0.03;  ///< [m]
constexpr double kMass = 0.1;     ///< [kg]
constexpr double kFriction = 0.3; ///< [-]
constexpr double kGravity = 9.81; ///< [m/s^2]
constexpr double kStep = 1e-3;    ///< of ODE [s]
constexpr double kSlip = 1e-3;    ///< of the surface, that counts as rolling [m/s]

/// A ball at rest on a plate of rubber (10 MPa) that is held below.
class BallOnPlate {
public:
    /// @param tilt  of gravity towards +x [rad].
    explicit BallOnPlate(double tilt = 0) : app_(kGravity) {
        dWorldSetGravity(app_.world, kGravity * std::sin(tilt), 0, -kGravity * std::cos(tilt));
        const MeshHandle mesh(dSoftMeshCreateBox(0.2, 0.05, 0.02, 16, 4, 2));
        plate_ = app_.add(mesh, SoftApp::solid(1e7, 1000, 0.3, 1e-5), Vec3(0, 0, -0.01),
                          Vec3::Zero(), kFriction);
        dSoftContact contact = dSoftContactDefault();
        contact.friction = kFriction;
        dSoftBodySetContact(plate_, &contact);
        std::vector<int> held;
        const std::vector<Vec3> x = SoftApp::positions(plate_);
        for (std::size_t i = 0; i < x.size(); ++i)
            if (x[i].z() < -0.0199)
                held.push_back(static_cast<int>(i));
        dSoftBodyPinNodes(plate_, held.data(), static_cast<int>(held.size()));
        ball_ = dBodyCreate(app_.world);
        dMass mass;
        dMassSetSphereTotal(&mass, kMass, kRadius);
        dBodySetMass(ball_, &mass);
        dBodySetPosition(ball_, -0.06, 0.003, kRadius);
        dGeomSetBody(dCreateSphere(app_.space, kRadius), ball_);
    }
    void settle() { // the slope's pull would let it roll
        const dReal g = kGravity;
        dVector3 pull;
        dWorldGetGravity(app_.world, pull);
        dWorldSetGravity(app_.world, 0, 0, -g);
        for (int i = 0; i < 150; ++i)
            step();
        dWorldSetGravity(app_.world, pull[0], pull[1], pull[2]);
    }
    void start(double speed, double spin) {
        dBodySetLinearVel(ball_, speed, 0, 0);
        dBodySetAngularVel(ball_, 0, spin, 0);
    }
    void step() { app_.step(kStep); }
    double speed() const { return dBodyGetLinearVel(ball_)[0]; }
    double spin() const { return dBodyGetAngularVel(ball_)[1]; }
    double slip() const { return speed() - spin() * kRadius; }
    double height() const { return dBodyGetPosition(ball_)[2]; }

private:
    SoftApp app_;
    dSoftBodyID plate_;
    dBodyID ball_;
};

/// What it does from now on, in the mean over some swings of the elastic foot it stands on:
/// friction lets go of a ball that slid with its spring stretched.
struct Rolling {
    double speed = 0;
    double slip = 0;
};
Rolling mean_motion(BallOnPlate& ball) {
    constexpr int kSteps = 60;
    Rolling sum;
    for (int i = 0; i < kSteps; ++i) {
        ball.step();
        sum.speed += ball.speed() / kSteps;
        sum.slip += ball.slip() / kSteps;
    }
    return sum;
}

/// Runs until it rolls. @return when [s].
double time_to_roll(BallOnPlate& ball, double at_most) {
    double before = ball.slip();
    for (double t = 0; t < at_most; t += kStep) {
        ball.step();
        const double now = ball.slip();
        if (std::fabs(now) < kSlip || now * before < 0) // the slip falls evenly
            return t + kStep * before / (before - now);
        before = now;
    }
    return at_most;
}

// Friction mu m g slows the middle by mu g and turns the ball by 5/2 mu g / R, till v = w R:
// t = 2 v / (7 mu g), v' = 5/7 v (e.g. J. Walker, Halliday & Resnick, Fundamentals of Physics, 11).
TEST(RollingBall, RollsAfterSlidingAsCoulombSays) {
    BallOnPlate ball;
    ball.settle();
    const double speed = 0.5;
    ball.start(speed, 0);
    const double exact = 2 * speed / (7 * kFriction * kGravity);
    const double time = time_to_roll(ball, 3 * exact);
    const Rolling after = mean_motion(ball);
    std::printf("slid: rolls after %.2f ms (%+.2f %%), at %.4f of 5/7 v, slip %.1e m/s\n",
                1e3 * time, 100 * (time / exact - 1), after.speed / (5.0 / 7 * speed), after.slip);
    EXPECT_NEAR(time, exact, 0.02 * exact);
    EXPECT_NEAR(after.speed, 5.0 / 7 * speed, 0.01 * speed);
    EXPECT_LT(std::fabs(after.slip), 0.01 * speed);
}

// The other way round: t = 2 w R / (7 mu g), v' = 2/7 w R.
TEST(RollingBall, RollsAfterSpinningAsCoulombSays) {
    BallOnPlate ball;
    ball.settle();
    const double spin = 15;
    ball.start(0, spin);
    const double exact = 2 * spin * kRadius / (7 * kFriction * kGravity);
    const double time = time_to_roll(ball, 3 * exact);
    const Rolling after = mean_motion(ball);
    std::printf("spun: rolls after %.2f ms (%+.2f %%), at %.4f of 2/7 w R, slip %.1e m/s\n",
                1e3 * time, 100 * (time / exact - 1), after.speed / (2.0 / 7 * spin * kRadius),
                after.slip);
    EXPECT_NEAR(time, exact, 0.02 * exact);
    EXPECT_NEAR(after.speed, 2.0 / 7 * spin * kRadius, 0.01 * spin * kRadius);
    EXPECT_LT(std::fabs(after.slip), 0.01 * spin * kRadius);
}

// 5/7 g sin of the slope, less what the rubber under it takes.
TEST(RollingBall, RollsDownASlopeWithFiveSeventhsOfItsPull) {
    const double tilt = 0.1;
    BallOnPlate ball(tilt);
    ball.settle();
    double slip = 0; // in the mean, see mean_motion()
    const double start = ball.speed();
    const int steps = 150;
    for (int i = 0; i < steps; ++i) {
        ball.step();
        slip += ball.slip() / steps;
    }
    const double pull = (ball.speed() - start) / (steps * kStep);
    const double exact = 5.0 / 7 * kGravity * std::sin(tilt);
    std::printf("down a slope: %.4f m/s^2 (%+.2f %%), slip %.1e m/s of %.2f; height %.4f\n", pull,
                100 * (pull / exact - 1), slip, ball.speed(), ball.height());
    EXPECT_NEAR(pull, exact, 0.03 * exact);
    EXPECT_LT(std::fabs(slip), 0.01 * ball.speed());
}

} // namespace
} // namespace ode::soft
