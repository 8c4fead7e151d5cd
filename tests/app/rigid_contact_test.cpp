// What bears, slides and rolls: rigid bodies of ODE that sound, through the public functions.
#include "support/rigid_ring.h"
#include "support/soft_app.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace {

using namespace ode;
using test::line;
using test::RigidRing;

constexpr double kTau = 2 * std::numbers::pi;

double lowest_mode(dSoundModalID voice) {
    dReal f = 0;
    dSoundModalGetModes(voice, 1, &f, nullptr);
    return f;
}

dSoundSurface surface(dReal loss) {
    dSoundSurface out = dSoundSurfaceDefault();
    out.loss = loss;
    return out;
}

constexpr double kSupport = 0.02, kApart = 0.08; // balls under the bar [m]

/// Decay of a bar's lowest mode that lies on two balls and is struck [1/s].
double decay(double gravity, dReal loss) {
    RigidRing app(-gravity);
    for (const double x : {-kApart, kApart})
        dGeomSetPosition(dCreateSphere(app.space, kSupport), x, 0, -kSupport);
    const dSoundSurface lossy = surface(loss);
    dSoundSetGeomSurface(app.sound, nullptr, &lossy);
    const RigidRing::Bar bar = app.add_bar(0, 0, 0.5 * RigidRing::kThick);
    app.run(0.3, 0.002);
    const dVector3 at = {0, 0, RigidRing::kThick}, blow = {0, 0, -1e-3};
    dSoundModalStrike(bar.voice, at, blow, 1e-4);
    app.run(0.15, 0.002);
    const std::vector<double> p = app.heard();
    const double f = lowest_mode(bar.voice);
    return std::log(line(p, f, 0.31, 0.34) / line(p, f, 0.34, 0.37)) / 0.03;
}

// The share of the mode's strain energy that is in the contacts, times their loss factor; the
// mode's shape by Euler and Bernoulli (S. S. Rao, Vibration of Continuous Systems, 11.5).
TEST(RigidContact, HoldsABarByItsShareOfTheStrainEnergy) {
    const double own = decay(9.81, 0), held = decay(9.81, 0.1) - own;
    const dSoftSolid steel = RigidRing::metal();
    const double m = steel.density * RigidRing::kLength * RigidRing::kWidth * RigidRing::kThick;
    const double per_modulus =
        (1 - steel.poisson * steel.poisson) / steel.young + (1 - 0.2 * 0.2) / 30e9;
    const double k = std::cbrt(6 / (per_modulus * per_modulus) * 0.5 * m * 9.81 * kSupport);
    const double b = 4.73004, s = 0.98250;
    const double u = b * (0.5 - kApart / RigidRing::kLength);
    const double across = std::cosh(u) + std::cos(u) - s * (std::sinh(u) + std::sin(u));
    const double along = 0.5 * RigidRing::kThick * b / RigidRing::kLength *
                         (std::sinh(u) - std::sin(u) - s * (std::cosh(u) + std::cos(u)));
    RigidRing app;
    const double w = kTau * lowest_mode(app.add_bar(0, 0, 0).voice);
    const auto share = [&](double stiffness) { return stiffness / (w * w + stiffness); };
    const double sideways = 2 * (1 - steel.poisson) / (2 - steel.poisson);
    const double expected =
        0.5 * w * 0.1 * 2 *
        (share(k * across * across / m) + share(sideways * k * along * along / m));
    EXPECT_NEAR(own, 0.5 * (steel.alpha + steel.beta * w * w), 0.05 * own);
    EXPECT_NEAR(held, expected, 0.08 * expected) << "a bar ten times as long as thick";
    std::printf("decay free %.2f /s, held %.2f more (theory %.2f)\n", own, held, expected);
    EXPECT_GT(held, 5 * own) << "it is muted";
    // Twice the loss; eight times the load is twice the stiffness.
    EXPECT_NEAR(decay(9.81, 0.2) - own, 2 * held, 0.05 * held);
    EXPECT_NEAR(decay(8 * 9.81, 0.1) - own, 2 * held, 0.15 * held);
}

dSoundSurface waves(std::vector<dReal>& height, double depth, double length) {
    height.resize(64);
    for (std::size_t i = 0; i < height.size(); ++i)
        height[i] = depth * std::sin(kTau * static_cast<double>(i) / 64);
    dSoundSurface out = dSoundSurfaceDefault();
    out.count = static_cast<int>(height.size());
    out.profile = height.data();
    out.spacing = length / 64;
    return out;
}

// A bar drawn over waves of a millimetre at 1 m/s hums at 1 kHz; let go, it comes to rest and is
// silent.
TEST(RigidContact, SlidesAtSpeedOverWavelength) {
    RigidRing app(-9.81);
    std::vector<dReal> height, level;
    const dSoundSurface wavy = waves(height, 1e-8, 1e-3), flat = waves(level, 0, 1e-3);
    const dGeomID floor = dCreatePlane(app.space, 0, 0, 1, 0);
    dSoundSetGeomSurface(app.sound, nullptr, &flat);
    dSoundSetGeomSurface(app.sound, floor, &wavy);
    const RigidRing::Bar bar = app.add_bar(-0.5, 0, 0.5 * RigidRing::kThick);
    for (int i = 0; i < 250; ++i) {
        dBodySetLinearVel(bar.body, 1, 0, 0);
        dBodySetAngularVel(bar.body, 0, 0, 0);
        app.step(0.002);
    }
    app.run(4, 0.002);
    const std::vector<double> p = app.heard();
    const double hum = line(p, 1000, 0.2, 0.45);
    EXPECT_GT(hum, 1e-6);
    for (const double f : {500., 800., 1250., 2000.})
        EXPECT_LT(line(p, f, 0.2, 0.45), 0.02 * hum) << f;
    EXPECT_EQ(*std::max_element(p.end() - RigidRing::kRate / 2, p.end()), 0);
}

constexpr double kRadius = 0.008; // of a steel ball [m]

/// What is heard of it above, as it rolls over waves of 0.4 mm.
std::vector<double> rolled(double speed, dReal depth) {
    RigidRing app(-9.81);
    dSoundListenerSetPosition(app.ears, 0.1, 0, 1);
    std::vector<dReal> height, level;
    const dSoundSurface wavy = waves(height, depth, 4e-4), flat = waves(level, 0, 4e-4);
    dSoundSetGeomSurface(app.sound, nullptr, &flat);
    dSoundSetGeomSurface(app.sound, dCreatePlane(app.space, 0, 0, 1, 0), &wavy);
    const dBodyID ball =
        app.add_sphere(kRadius, 7850 * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3), kRadius);
    const soft::MeshHandle mesh(dSoftMeshCreateSphere(kRadius, 2));
    const dSoftSolid steel = RigidRing::metal();
    dSoundModalCreate(ball, mesh, &steel);
    dBodySetLinearVel(ball, speed, 0, 0);
    dBodySetAngularVel(ball, 0, speed / kRadius, 0);
    app.run(0.35, 0.002);
    return app.heard();
}

TEST(RigidContact, RollsAtSpeedOverWavelength) {
    const std::vector<double> p = rolled(0.4, 1e-9), again = rolled(0.4, 1e-9);
    EXPECT_EQ(p, again) << "the same bits every time";
    const double hum = line(p, 1000, 0.1, 0.34);
    // Shaken by the waves below the resonance of its contact, as a rigid sphere sounds (D the
    // dipole of sphere and carried air, rho a^3 / 2): p = D w a / (c r).
    const dSoftSolid steel = RigidRing::metal();
    const double m = 7850 * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
    const double per_modulus =
        (1 - steel.poisson * steel.poisson) / steel.young + (1 - 0.2 * 0.2) / 30e9;
    const double k = std::cbrt(6 / (per_modulus * per_modulus) * m * 9.81 * kRadius);
    const double w = kTau * 1000, shaken = 1e-9 * w * w / (1 - w * w * m / k);
    // The contact feels the mean over its width.
    const double wide = 2 * std::cbrt(0.75 * m * 9.81 * kRadius * per_modulus);
    const double felt = std::sin(std::numbers::pi * wide / 4e-4) / (std::numbers::pi * wide / 4e-4);
    const double expected =
        felt * 1.21 * std::pow(kRadius, 3) / 2 * w * shaken / (343 * (1 - kRadius));
    std::printf("rolls at 1 kHz: %+.2f dB\n", 20 * std::log10(hum / expected));
    EXPECT_NEAR(hum, expected, 0.08 * expected) << "a ball shaken at the waves' rate";
    for (const double f : {600., 800., 1250., 1500.})
        EXPECT_LT(line(p, f, 0.1, 0.34), 0.02 * hum) << f;
    const std::vector<double> level = rolled(0.4, 0);
    EXPECT_LT(*std::max_element(level.begin() + 4800, level.end()), 1e-9) << "nothing to ride over";
}

TEST(RigidContact, SurfacesThatAreNone) {
    RigidRing app;
    const test::Messages messages;
    dSoundSurface bad = surface(2);
    EXPECT_EQ(dSoundSetGeomSurface(app.sound, nullptr, &bad), 0);
    EXPECT_GT(test::Messages::with("the loss factor is 2; give one from 0 to 1"), 0);
    bad = dSoundSurfaceDefault();
    bad.shortest = bad.longest;
    EXPECT_EQ(dSoundSetGeomSurface(app.sound, nullptr, &bad), 0);
    bad = dSoundSurfaceDefault();
    bad.count = 1;
    EXPECT_EQ(dSoundSetGeomSurface(app.sound, nullptr, &bad), 0);
    EXPECT_GT(test::Messages::with("a profile of 1 heights"), 0) << test::Messages::text();
    const dSoundSurface good = dSoundSurfaceDefault();
    EXPECT_EQ(dSoundSetGeomSurface(app.sound, nullptr, &good), 1);
}

} // namespace
