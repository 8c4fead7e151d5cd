#include "bench/sound/audio_measures.h"

#include <gtest/gtest.h>

namespace ode::sound::test {
namespace {

// Point source: p = rho w Q / (4 pi r), Pierce, Acoustics, ch. 4. Radius 0.2 mm: ka < 0.08 at
// 20 kHz, and the mean of e^{-ikR} over the sphere, sin(ka)/ka, is -0.01 dB.
constexpr double kRadius = 2e-4;
constexpr double kStroke = 1e-5;
constexpr double kDistance = 0.5;

struct Heard {
    double level;    ///< over the point source's pressure amplitude
    double residual; ///< rms of all else from 20 Hz to 20 kHz over that amplitude's rms
};

Heard listen(double frequency, double dt, int rate) {
    Settings settings = Rig::unit_settings();
    settings.rate = rate;
    Rig rig(settings, dt);
    const Shape shape = make_sphere(1);
    rig.listener->pose.centre = {0.0, 0.0, kDistance};
    rig.listener->pose.ear_distance = 0.0;
    rig.add(shape, pulsate(kRadius, kStroke, frequency));
    rig.run(0.1);
    const std::vector<double> out = rig.heard(0.02, 0.09);
    const Air air;
    const double expected = air.density * kTau * frequency *
                            flow_amplitude(shape, kRadius, kStroke, frequency) /
                            (2.0 * kTau * kDistance);
    return {std::abs(phasor(out, rate, frequency)) / expected,
            band_rms(out, rate, 20.0, 20000.0) * std::numbers::sqrt2 / expected};
}

class Response : public testing::TestWithParam<double> {};

// accuracy.md 6: 0.5 dB to 20 kHz. Two boxes of 2.6 us take 0.08 dB at 20 kHz, the rest is flat.
TEST_P(Response, IsFlatToTwentyKilohertz) {
    EXPECT_NEAR(decibel(listen(GetParam(), 0.6e-6, 48000).level), 0.0, 0.1);
}

// 10 us is longer than the wanted interval of 2.6 us. The slopes of the flow make up for the boxes:
// what is left is of the fourth order, (w dt)^4 / 240 and what differences miss of a slope.
TEST_P(Response, IsFlatForLongSubsteps) {
    EXPECT_NEAR(decibel(listen(GetParam(), 10e-6, 48000).level), 0.0, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Frequencies, Response,
                         testing::Values(100.0, 1000.0, 5000.0, 10000.0, 15000.0, 19000.0,
                                         20000.0));

class Alias : public testing::TestWithParam<double> {};

// What lies above the audible must not fold back: -90 dB of the pressure that the ultrasound has.
TEST_P(Alias, StaysBelowMinusNinety) {
    EXPECT_LT(decibel(listen(GetParam(), 0.6e-6, 48000).residual), -90.0);
}

INSTANTIATE_TEST_SUITE_P(Frequencies, Alias,
                         testing::Values(24500.0, 28100.0, 33000.0, 47000.0, 52000.0, 71000.0,
                                         77000.0, 95000.0, 101000.0, 150000.0, 200000.0));

// Substeps of 0.6 us, each up to 40 % longer or shorter: the lengths of the gathers' intervals
// waver. Slopes of the flow hold the mark of -90 dB for what borders on the audible; at 71 kHz they
// leave -85 dB, at 101 kHz -82 dB (softsound bench audio).
TEST(Alias, OfUnevenSubstepsStaysLow) {
    Settings settings = Rig::unit_settings();
    const Substeps uneven{"", 0.6e-6, 0.4};
    EXPECT_NEAR(tone(settings, uneven, 20000.0).level, 0.0, 0.1);
    EXPECT_LT(tone(settings, uneven, 28100.0).rest, -90.0);
    EXPECT_LT(tone(settings, uneven, 71000.0).rest, -100.0);
}

TEST(Response, At44100IsFlatAndFree) {
    // Intervals of 3 us: two boxes take 0.10 dB.
    EXPECT_NEAR(decibel(listen(20000.0, 1e-6, 44100).level), -0.10, 0.05);
    EXPECT_LT(decibel(listen(24500.0, 1e-6, 44100).residual), -90.0);
}

} // namespace
} // namespace ode::sound::test
