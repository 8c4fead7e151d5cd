// Rigid bodies of ODE that sound when contact joints strike them, through the public functions.
#include "support/rigid_ring.h"
#include "support/soft_app.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <cstdarg>
#include <cstdio>
#include <dlfcn.h>
#include <numbers>
#include <string>

namespace {

using namespace ode;
using test::line;
using test::RigidRing;

double peak(const std::vector<double>& p, double from = 0, double to = 1e9) {
    double most = 0;
    for (std::size_t i = static_cast<std::size_t>(from * RigidRing::kRate);
         i < p.size() && static_cast<double>(i) < to * RigidRing::kRate; ++i)
        most = std::max(most, std::fabs(p[i]));
    return most;
}

/// ODE's own, whose joints the library doesn't see being made.
decltype(&dJointCreateContact) unseen() {
    void* const ode = dlopen("libode.so.8", RTLD_NOW | RTLD_NOLOAD);
    return reinterpret_cast<decltype(&dJointCreateContact)>(dlsym(ode, "dJointCreateContact"));
}

double lowest_mode(dSoundModalID voice) {
    dReal f = 0;
    dSoundModalGetModes(voice, 1, &f, nullptr);
    return f;
}

using Step = int (*)(dWorldID, dReal);
class RigidSound : public testing::TestWithParam<Step> {};
INSTANTIATE_TEST_SUITE_P(Steps, RigidSound, testing::Values(dWorldStep, dWorldQuickStep),
                         [](const auto& given) {
                             return std::string(given.param == dWorldStep ? "Step" : "QuickStep");
                         });

// A bar that falls on a ball under its middle: the lowest bending
// mode is heard, at its frequency.
TEST_P(RigidSound, ABarRingsAtItsModeWhenItHasFallen) {
    RigidRing app(-9.81);
    app.bounce = 0.5;
    dGeomSetPosition(dCreateSphere(app.space, 0.02), 0, 0, -0.02);
    const RigidRing::Bar bar = app.add_bar(0, 0, 0.05);
    ASSERT_TRUE(bar.voice);
    for (int i = 0; i < 60; ++i)
        app.step(0.004, GetParam());
    EXPECT_GE(RigidRing::status(bar.voice).blows, 1u);
    EXPECT_GT(RigidRing::status(bar.voice).energy, 0);
    const double f = lowest_mode(bar.voice); // 2.5 kHz
    app.sound.reset();
    const std::vector<double> p = app.heard();
    EXPECT_EQ(peak(p, 0, 0.085), 0) << "sqrt(2 * 0.04 / g) = 0.09 s of fall";
    const double at = line(p, f, 0.11, 0.2);
    EXPECT_GT(at, 0.01);
    EXPECT_GT(at, 20 * line(p, 1.1 * f, 0.11, 0.2));
}

// What rests is not struck again and again; what rang dies away to nothing at all.
TEST_P(RigidSound, ABarAtRestIsSilent) {
    for (const double h : {0.001, 0.005, 0.016}) {
        RigidRing app(-9.81);
        dCreatePlane(app.space, 0, 0, 1, 0);
        const RigidRing::Bar bar = app.add_bar(0, 0, 0.02);
        for (int i = 0; i < 1.0 / h; ++i)
            app.step(h, GetParam());
        const unsigned long landed = RigidRing::status(bar.voice).blows;
        EXPECT_GE(landed, 1u);
        EXPECT_LE(landed, 12u) << h;
        for (int i = 0; i < 4.0 / h; ++i)
            app.step(h, GetParam());
        EXPECT_EQ(RigidRing::status(bar.voice).blows, landed) << h;
        EXPECT_EQ(peak(app.heard(), 4.5), 0) << h;
    }
}

struct Hit {
    double onset, level; ///< [s], [dB]
};
Hit thrown(double h, bool seen = true) {
    RigidRing app;
    if (!seen)
        app.join = unseen();
    app.bounce = 0.6;
    dGeomSetPosition(dCreateSphere(app.space, 0.02), 0.07, 0, -0.02 - 0.5 * RigidRing::kThick);
    const RigidRing::Bar bar = app.add_bar(0, 0, 0.0777); // 77.7 ms
    dBodySetLinearVel(bar.body, 0, 0, -1);
    app.run(0.4, h);
    const std::vector<double> p = app.heard();
    const double most = peak(p);
    std::size_t first = 0;
    while (first < p.size() && std::fabs(p[first]) < 0.1 * most)
        ++first;
    return {static_cast<double>(first) / RigidRing::kRate,
            20 * std::log10(line(p, lowest_mode(bar.voice), 0.12, 0.3))};
}

// The same blow whatever ODE's step.
TEST(RigidRing, HearsNoDifferenceBetweenStepsOf1And5And16Milliseconds) {
    const Hit fine = thrown(0.001);
    EXPECT_NEAR(fine.onset, 0.0777 + 1.0 / 343, 5e-4);
    for (const double h : {0.0005, 0.005, 0.016, 0.02}) {
        const Hit hit = thrown(h);
        std::printf("step %.1f ms: %+.3f ms, %+.2f dB\n", 1e3 * h, 1e3 * (hit.onset - fine.onset),
                    hit.level - fine.level);
        EXPECT_NEAR(hit.onset, fine.onset, 1e-3);
        EXPECT_NEAR(hit.level, fine.level, 1.0);
    }
}

// Nor whether it was seen that the joint was made: where it is, how deep and what of is found
// again.
TEST(RigidRing, HearsContactsThatItDidntSeeBeingMade) {
    ASSERT_NE(unseen(), &dJointCreateContact);
    for (const double h : {0.001, 0.005, 0.016}) {
        const Hit hit = thrown(h, false), seen = thrown(h);
        EXPECT_NEAR(hit.onset, seen.onset, 1e-4) << h;
        EXPECT_NEAR(hit.level, seen.level, 0.1) << h;
    }
    // A fall on the ground, four corners: energy as where all is seen.
    double energy[2];
    for (int i = 0; i < 2; ++i) {
        RigidRing app(-9.81);
        app.join = i == 0 ? &dJointCreateContact : unseen();
        dCreatePlane(app.space, 0, 0, 1, 0);
        const RigidRing::Bar bar = app.add_bar(0, 0, 0.05);
        app.run(0.12, 0.004);
        energy[i] = RigidRing::status(bar.voice).energy;
    }
    EXPECT_GT(energy[0], 0);
    EXPECT_NEAR(energy[1], energy[0], 0.02 * energy[0]);
}

// The application's own feedback is read, not replaced.
TEST(RigidRing, LeavesTheApplicationsFeedbackAlone) {
    RigidRing app(-9.81);
    dJointFeedback own{};
    app.feedback = &own;
    dCreatePlane(app.space, 0, 0, 1, 0);
    const RigidRing::Bar bar = app.add_bar(0, 0, 0.0101);
    dBodySetLinearVel(bar.body, 0, 0, -0.5);
    double most = 0;
    for (int i = 0; i < 20; ++i) {
        app.step(0.002);
        most = std::max(most, own.f1[2]);
    }
    EXPECT_GT(most, 1);
    EXPECT_GE(RigidRing::status(bar.voice).blows, 1u);
}

// The click of what is too small to ring: a steel ball, given a push, against a sphere that the
// same push sets moving (A. D. Pierce, Acoustics, 1989, 4-2), worked out at a step of a twentieth.
TEST(RigidRing, ABallsClickIsASpheresThatIsPushed) {
    constexpr double kRadius = 0.008, kPush = 0.002, kTime = 1.5e-4, kFar = 1.0;
    constexpr double kDensity = 7850, kAir = 1.21, kSpeed = 343;
    RigidRing app;
    const double mass = kDensity * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
    const dBodyID ball = app.add_sphere(kRadius, mass, 0);
    const soft::MeshHandle mesh(dSoftMeshCreateSphere(kRadius, 3));
    const dSoftSolid steel = RigidRing::metal();
    const dSoundModalID voice = dSoundModalCreate(ball, mesh, &steel);
    ASSERT_EQ(dSoundModalGetModes(voice, 0, nullptr, nullptr), 0);
    app.step(0.002);
    const dVector3 at = {0, -kRadius, 0}, push = {0, -kPush, 0}; // towards the ear
    dSoundModalStrike(voice, at, push, kTime);
    app.run(0.03, 0.002);
    const std::vector<double> p = app.heard();

    // D = rho/(4 pi) 3/2 volume, V by T^2 V''/2 + T V' + V = U; what U has got fades in 5 ms.
    // Facets leave out some of the ball.
    const double share = RigidRing::status(voice).mass / mass;
    const double dipole =
        share * kAir / (4 * std::numbers::pi) * 2 * std::numbers::pi * std::pow(kRadius, 3);
    EXPECT_LT(share, 1);
    const double T = kRadius / kSpeed, fine = 1.0 / (20 * RigidRing::kRate);
    double all = 0;
    for (double t = 0; t < kTime; t += fine)
        all += fine * std::pow(std::sin(std::numbers::pi * t / kTime), 1.5);
    std::vector<double> flow;
    double u = 0, v = 0, slope = 0;
    for (double t = 0; t < 0.01; t += fine) {
        const double force =
            t < kTime ? kPush / all * std::pow(std::sin(std::numbers::pi * t / kTime), 1.5) : 0;
        u += fine * (force / mass - u / 5e-3);
        slope += fine * 2 / (T * T) * (u - v - T * slope);
        v += fine * slope;
        flow.push_back(dipole * (v / kFar + slope / kSpeed) / kFar);
    }
    std::vector<double> expected;
    for (std::size_t i = 20; i + 20 < flow.size(); i += 20)
        expected.push_back((flow[i + 10] - flow[i - 10]) / (20 * fine));
    const double loudest = *std::max_element(expected.begin(), expected.end());
    EXPECT_NEAR(peak(p), loudest, 0.1 * loudest);
    const auto power = [](const std::vector<double>& of, double f, int each) {
        std::complex<double> sum = 0;
        for (std::size_t i = 0; i < of.size(); ++i)
            sum += of[i] * std::polar(1.0, -2 * std::numbers::pi * f * static_cast<double>(i) /
                                               (each * RigidRing::kRate));
        return 20 * std::log10(std::abs(sum) / each);
    };
    std::vector<double> slopes;
    for (std::size_t i = 0; i + 1 < flow.size(); ++i)
        slopes.push_back((flow[i + 1] - flow[i]) / fine);
    // 0.18 dB below it is what the facets leave out of the ball and of its air.
    for (const double f : {500., 1000., 2000., 4000., 8000., 12000., 16000.}) {
        const double off = power(p, f, 1) - power(slopes, f, 20);
        std::printf("%.0f Hz: %+.2f dB\n", f, off);
        EXPECT_NEAR(off, 0, 0.4) << f;
    }
    std::printf("peak: %+.2f dB\n", 20 * std::log10(peak(p) / loudest));
}

// Two bodies' sound is the sum of each alone.
TEST(RigidRing, SuperposesBodies) {
    const std::vector<double> both = test::two_bars(true, true), a = test::two_bars(true, false),
                              b = test::two_bars(false, true);
    ASSERT_GT(peak(a), 1e-4);
    double off = 0;
    for (std::size_t i = 0; i < both.size(); ++i)
        off = std::max(off, std::fabs(both[i] - a[i] - b[i]));
    EXPECT_LT(off, 1e-6 * peak(both)); // the sink's floats
}

TEST(RigidRing, EndsWithItsBodyAndItsWorld) {
    RigidRing app(-9.81);
    const RigidRing::Bar bar = app.add_bar(0, 0, 1), other = app.add_bar(0, 1, 1);
    app.step(0.005);
    const dVector3 at = {0.05, 0, 1}, blow = {0, 0, 0.01};
    dSoundModalStrike(bar.voice, at, blow, 1e-4);
    app.run(0.02, 0.005);
    dBodyDestroy(bar.body);
    app.run(0.02, 0.005);
    EXPECT_EQ(dSoundModalGetBody(bar.voice), nullptr);
    dSoundModalDestroy(bar.voice);
    dSoundModalDestroy(other.voice);
    app.run(0.05, 0.005);
    EXPECT_EQ(peak(app.heard(), 0.06), 0) << "faded within 5 ms, 3 ms on the way";
}

TEST(RigidRing, NeedsSomebodyWhoListensToItsWorld) {
    test::OdeApp app;
    const soft::WorldHandle soft(dSoftWorldCreate(app.world, app.space));
    const dBodyID body = app.add_sphere(0.1, 1, 0);
    const soft::MeshHandle mesh(dSoftMeshCreateSphere(0.1, 1));
    const dSoftSolid steel = dSoftSolidDefault();
    const test::Messages messages;
    EXPECT_EQ(dSoundModalCreate(body, mesh, &steel), nullptr);
    EXPECT_EQ(test::Messages::with("dSoundWorldCreate() first"), 1) << test::Messages::text();
}

} // namespace
