#include "physics/sound/rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace ode::sound::test {
namespace {

double peak(const std::vector<double>& samples) {
    double top = 0.0;
    for (const double s : samples)
        top = std::isfinite(s) ? std::max(top, std::abs(s)) : 1e300;
    return top;
}

TEST(Silence, BodyAtRestGivesExactZeros) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 0.5, 0.0};
    rig.add(make_sphere(2), [](double) { return Placement{{0.0, 0.0, 0.1}, 0.1, 0.3}; });
    rig.run(0.1);
    EXPECT_GT(rig.recorder.ear[0].size(), 4600u);
    EXPECT_THAT(rig.recorder.ear[0], testing::Each(0.0));
    EXPECT_THAT(rig.recorder.ear[1], testing::Each(0.0));
}

// Steady flight radiates nothing (D'Alembert). The rule sees a dipole whose retarded field changes
// as the sphere passes by: p <= rho/(4 pi) * 2 V v^2 / R^3 with the sphere's volume V, far below
// the audible. Rounding is the rest: no hiss above that.
TEST(Silence, SteadyFlightHasNoHiss) {
    const double v = 10.0, radius = 0.05, distance = 1.0;
    Rig rig;
    rig.listener->pose.centre = {0.0, distance, 0.0};
    rig.add(make_sphere(2), [=](double t) {
        return Placement{{v * (t - 0.1), 0.0, 0.0}, radius, 0.0};
    });
    rig.run(0.2);
    const std::vector<double> out = rig.heard(0.03, 0.18);
    const double volume = kTau * 2.0 / 3.0 * radius * radius * radius;
    const double bound =
        Air{}.density / (2.0 * kTau) * 2.0 * volume * v * v / std::pow(distance - 0.2, 3);
    EXPECT_LT(peak(out), bound);
    // Of each node's flow, -130 dB comes through as image at (v/c) 96 kHz. Mark: the threshold of
    // hearing.
    EXPECT_LT(band_rms(out, rig.rate(), 200.0, 20000.0), 2e-5);
}

// A sphere that spins about an axis of its own sweeps no volume. Area vectors follow with a second-
// order lag; their mesh-sized facets keep still in the sphere's frame.
TEST(Silence, SpinningSphereIsQuiet) {
    const double spin = 100.0, radius = 0.05; // 16 turns a second, rim at 5 m/s
    Rig rig;
    rig.listener->pose.centre = {0.0, 0.5, 0.0};
    rig.add(make_sphere(2), [=](double t) { return Placement{Vec3::Zero(), radius, spin * t}; });
    rig.run(0.1);
    EXPECT_LT(band_rms(rig.heard(0.03, 0.09), rig.rate(), 20.0, 20000.0), 1e-3);
}

TEST(Linearity, TwoBodiesAreTheSumOfEach) {
    const auto run = [](bool first, bool second) {
        Rig rig;
        rig.listener->pose.centre = {0.0, 0.5, 0.1};
        if (first)
            rig.add(make_sphere(1), pulsate(0.02, 1e-4, 700.0, {0.3, 0.0, 0.0}));
        if (second)
            rig.add(make_sphere(2), [](double t) {
                return Placement{{-0.4, 2.0 * t, 0.0}, 0.05 + 1e-6 * std::sin(9000.0 * t), 0.0};
            });
        rig.run(0.06);
        return rig.heard(0.0, 0.055, 1);
    };
    const std::vector<double> a = run(true, false), b = run(false, true), both = run(true, true);
    const double scale = peak(both);
    ASSERT_GT(scale, 0.0);
    for (std::size_t i = 0; i < both.size(); ++i)
        ASSERT_NEAR(both[i], a[i] + b[i], 2e-7 * scale) << i; // the recording is in floats: 2^-24
}

TEST(Determinism, SameInputSameBits) {
    const auto run = [] {
        Rig rig;
        rig.listener->pose.centre = {0.0, 0.5, 0.1};
        rig.add(make_sphere(2), pulsate(0.02, 1e-4, 700.0, {0.3, 0.0, 0.0}));
        rig.run(0.03);
        return rig.recorder.ear[0];
    };
    EXPECT_EQ(run(), run());
}

/// Loudest sample-to-sample jump around an event over the loudest in undisturbed sound.
double click(const std::vector<double>& out, std::size_t quiet_from, std::size_t quiet_to,
             std::size_t from, std::size_t to) {
    const auto jump = [&](std::size_t a, std::size_t b) {
        double top = 0.0;
        for (std::size_t i = a + 1; i < b; ++i)
            top = std::max(top, std::abs(out[i] - out[i - 1]));
        return top;
    };
    return jump(from, to) / jump(quiet_from, quiet_to);
}

TEST(Click, NoneWhenABodyEnds) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 0.3, 0.0};
    const int body = rig.add(make_sphere(1), pulsate(0.02, 1e-4, 440.0));
    rig.run(0.1025); // in mid period
    rig.remove(body);
    rig.run(0.1);
    const std::vector<double> out = rig.heard(0.0, 0.19);
    // A step of the pressure would jump by 1/(2 pi 440/48000) = 17 times.
    EXPECT_LT(click(out, 2400, 4800, 4800, 5300), 3.0);
    EXPECT_EQ(peak(rig.heard(0.15, 0.19)), 0.0);
}

TEST(Click, NoneWhenABodyIsFirstSeenInFlight) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 0.3, 0.0};
    rig.run(0.05);
    rig.add(make_sphere(1), [](double t) {
        return Placement{{3.0 * (t - 0.05), 0.0, 0.0}, 0.05, 0.0};
    });
    rig.run(0.1);
    EXPECT_EQ(peak(rig.heard(0.0, 0.049)), 0.0); // filters ring for a millisecond before
    // A step of the dipole's flow would be rho/(4 pi) * A v / (2 R) * 40 kHz, some 100 Pa.
    EXPECT_LT(peak(rig.heard(0.05, 0.14)), 0.5);
}

TEST(Click, NoneWhenABodyIsTeleported) {
    const double f = 440.0;
    Rig rig;
    rig.listener->pose.centre = {0.0, 1.0, 0.0};
    Vec3 centre(0.5, 0.0, 0.0);
    rig.before_step = [&](double t) {
        if (t > 0.0999)
            centre = {-0.7, 0.0, 0.0};
    };
    rig.add(make_sphere(1), [&](double t) { return pulsate(0.02, 1e-4, f, centre)(t); });
    rig.run(0.2);
    const std::vector<double> out = rig.heard(0.0, 0.19);
    EXPECT_LT(click(out, 2400, 4800, 4800, 5300), 1.5);
}

TEST(Click, NoneWhenTheListenerIsTeleported) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 1.0, 0.0};
    rig.add(make_sphere(1), pulsate(0.02, 1e-4, 440.0));
    rig.before_step = [&](double t) {
        if (t > 0.0999)
            rig.listener->pose.centre = {0.0, 0.0, -1.1};
    };
    rig.run(0.2);
    EXPECT_LT(click(rig.heard(0.0, 0.19), 2400, 4800, 4800, 5600), 1.5);
}

TEST(Extreme, EarOnTheSurfaceAndInsideStaysFinite) {
    for (const double z : {0.0, 0.05, 0.04999}) {
        Rig rig;
        rig.listener->pose.centre = {0.0, 0.0, z};
        rig.listener->pose.ear_distance = 0.0;
        rig.add(make_sphere(2), pulsate(0.05, 1e-4, 440.0));
        rig.run(0.05);
        const double top = peak(rig.heard(0.01, 0.04));
        // Inside a pulsating sphere of uniform flow p = rho w Q / (4 pi a): no more near its skin
        // than twice that (the node at hand counts as a disk).
        const double w = kTau * 440.0;
        const double uniform = Air{}.density * w * (w * 0.05e-4) * 0.05;
        EXPECT_GT(top, 0.5 * uniform);
        EXPECT_LT(top, 2.0 * uniform);
    }
}

TEST(Extreme, SupersonicSourceStaysFinite) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 1.0, 0.0};
    rig.add(make_sphere(1), [](double t) {
        return pulsate(0.02, 1e-3, 440.0, {600.0 * (t - 0.05), 0.0, 0.0})(t);
    });
    rig.run(0.1);
    const double top = peak(rig.heard(0.0, 0.09));
    EXPECT_GT(top, 0.0);
    EXPECT_LT(top, 1e6);
}

TEST(Extreme, BodyGoneToPiecesIsSilentNotContagious) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 1.0, 0.0};
    const int broken = rig.add(make_sphere(1), [](double t) {
        return Placement{{0.0, t < 0.05 ? 0.0 : std::nan(""), 0.0}, 0.02, 0.0};
    });
    rig.add(make_sphere(1), pulsate(0.02, 1e-4, 440.0, {0.3, 0.0, 0.0}));
    rig.run(0.1);
    rig.remove(broken);
    rig.run(0.05);
    const std::vector<double> out = rig.heard(0.0, 0.14);
    EXPECT_LT(peak(out), 1.0);
    EXPECT_LT(click(out, 1000, 2400, 2400, 6700), 1.1);
}

TEST(Sleep, SleepingBodyCostsNothingAndWakesWithoutAClick) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 0.3, 0.0};
    const int body = rig.add(make_sphere(1), [](double t) {
        // At rest until 0.1 s, then a strike: displacement begins with zero velocity.
        const double s = std::max(0.0, t - 0.1);
        return Placement{Vec3::Zero(), 0.05 * (1.0 + 1e-5 * (1.0 - std::cos(kTau * 1000.0 * s))),
                         0.0};
    });
    rig.run(0.02);
    const unsigned long before = rig.scene.count().gathers;
    rig.wake(body, false);
    rig.run(0.08);
    EXPECT_EQ(rig.scene.count().gathers, before);
    rig.wake(body, true);
    rig.run(0.05);
    EXPECT_EQ(peak(rig.heard(0.0, 0.0995)), 0.0); // filters ring for a millisecond before
    // The attack is whole: amplitude of the steady tone from the start.
    const double early = peak(rig.heard(0.101, 0.103)), late = peak(rig.heard(0.12, 0.14));
    EXPECT_NEAR(decibel(early / late), 0.0, 0.5);
}

TEST(Flush, PlaysOutWhatTravels) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 100.0, 0.0}; // 0.29 s away
    rig.add(make_sphere(1), pulsate(0.02, 1e-3, 440.0));
    rig.run(0.1);
    EXPECT_EQ(peak(rig.heard(0.0, 0.1)), 0.0);
    rig.finish();
    EXPECT_GE(rig.recorder.ear[0].size(), static_cast<std::size_t>(0.39 * rig.rate()));
    EXPECT_LE(rig.recorder.ear[0].size(), static_cast<std::size_t>(0.42 * rig.rate()));
    EXPECT_GT(peak(rig.heard(0.3, 0.38)), 0.0);
}

} // namespace
} // namespace ode::sound::test
