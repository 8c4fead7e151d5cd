// Newton's cradle: a blow that goes through contacts which were there already.
#include "support/rigid_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <cstdio>
#include <numbers>

namespace {

using namespace ode;
using test::RigidRing;

constexpr double kRadius = 0.02, kString = 0.3, kTouch = 2e-5; ///< [m]
constexpr int kBalls = 5;

struct Cradle : RigidRing {
    std::array<dBodyID, kBalls> ball;
    std::array<dSoundModalID, kBalls> voice;
    double mass = 7850 * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);

    /// @param heard  the others are muted; negative: none is.  @param first  of those that hang.
    explicit Cradle(int heard, int first = 0) : RigidRing(-9.81) {
        dWorldSetContactSurfaceLayer(world, 2 * kTouch); // they stay in touch
        dSoundListenerSetPosition(ears, 1.2, 0, 0.2);
        const soft::MeshHandle mesh(dSoftMeshCreateSphere(kRadius, 3));
        const dSoftSolid steel = RigidRing::metal();
        for (int i = first; i < kBalls; ++i) {
            const auto at = static_cast<std::size_t>(i);
            ball[at] = add_sphere(kRadius, mass, 0);
            dBodySetPosition(ball[at], place(i), 0, 0);
            const dJointID string = dJointCreateBall(world, nullptr);
            dJointAttach(string, ball[at], nullptr);
            dJointSetBallAnchor(string, place(i), 0, kString);
            voice[at] = dSoundModalCreate(ball[at], mesh, &steel);
            if (heard >= 0 && i != heard)
                dSoundModalSetGain(voice[at], 0);
        }
    }
    /// By dWorldQuickStep: dWorldStep's solver gives up on balls that touch at rest ("LCP internal
    /// error"), and then solves nothing.
    void step(double h) {
        dSpaceCollide(space, this, [](void* data, dGeomID a, dGeomID b) {
            auto& self = *static_cast<Cradle*>(data);
            dContact contact{};
            if (dCollide(a, b, 1, &contact.geom, sizeof contact) == 0)
                return;
            contact.surface.mode = dContactBounce;
            contact.surface.bounce = 0.9;
            contact.surface.bounce_vel = 0.01;
            dJointAttach(dJointCreateContact(self.world, self.contacts, &contact), dGeomGetBody(a),
                         dGeomGetBody(b));
        });
        dWorldQuickStep(world, h);
        dJointGroupEmpty(contacts);
    }
    void run(double seconds, double h) {
        for (long i = std::lround(seconds / h); i > 0; --i)
            step(h);
    }
    static double place(int i) { return i * (2 * kRadius - kTouch); }
    double speed(int i) const { return dBodyGetLinearVel(ball[static_cast<std::size_t>(i)])[0]; }
    /// The first ball comes at 1 m/s at the others, which hang at rest.
    void swing(double h) {
        run(0.1, h);
        const double angle = -0.06;
        dBodySetPosition(ball[0], kString * std::sin(angle), 0, kString * (1 - std::cos(angle)));
        dQuaternion q;
        dQFromAxisAndAngle(q, 0, 1, 0, -angle);
        dBodySetQuaternion(ball[0], q);
        dBodySetLinearVel(ball[0], std::cos(angle), 0, std::sin(angle));
        dBodySetAngularVel(ball[0], 0, -1 / kString, 0);
        run(0.08, h);
    }
};

double click(const std::vector<double>& p, double f) {
    std::complex<double> sum = 0;
    for (std::size_t i = 4800; i < p.size(); ++i)
        sum += p[i] * std::polar(1.0, -2 * std::numbers::pi * f * static_cast<double>(i) /
                                          RigidRing::kRate);
    return std::abs(sum);
}

TEST(RigidCradle, FirstAndLastContactSound) {
    for (const double h : {0.001, 0.004}) {
        Cradle all(-1);
        all.run(0.1, h);
        for (const dSoundModalID own : all.voice)
            ASSERT_EQ(RigidRing::status(own).blows, 0u) << "they hang at rest";
        all.swing(h);
        for (int i = 0; i < kBalls; ++i)
            EXPECT_GE(RigidRing::status(all.voice[static_cast<std::size_t>(i)]).blows, 1u)
                << i << " at " << h;
        EXPECT_LE(RigidRing::status(all.voice.back()).blows, 2u) << "once, if it isn't caught up";
    }
}

// The last ball clicks as loud as what ODE gave it: against the same ball, alone, struck so.
TEST(RigidCradle, TheLastBallIsAsLoudAsItsImpulse) {
    constexpr double kStep = 0.001;
    Cradle cradle(kBalls - 1);
    cradle.swing(kStep);
    const std::vector<double> p = cradle.heard();
    const double speed = cradle.speed(kBalls - 1);
    ASSERT_GT(speed, 0.1);
    double momentum = 0;
    for (int i = 0; i < kBalls; ++i)
        momentum += cradle.speed(i);
    EXPECT_NEAR(momentum, 1, 0.08)
        << "ODE's, which the voices don't touch; it swings back a little";

    Cradle alone(kBalls - 1, kBalls - 1);
    alone.run(0.12, kStep);
    const double x = Cradle::place(kBalls - 1);
    const dVector3 at = {x - kRadius, 0, 0}, push = {cradle.mass * speed, 0, 0};
    dSoundModalStrike(alone.voice.back(), at, push, 1e-4);
    alone.run(0.06, kStep);
    const std::vector<double> q = alone.heard();
    for (const double f : {500., 1000., 1500.}) {
        const double off = 20 * std::log10(click(p, f) / click(q, f));
        std::printf("%.0f Hz: %+.2f dB\n", f, off);
        EXPECT_NEAR(off, 0, 1) << f;
    }
}

} // namespace
