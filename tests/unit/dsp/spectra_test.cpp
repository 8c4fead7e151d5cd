#include "dsp/spectra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kRate = 48000.0;

std::vector<double> tone(double f, double amplitude, double phase, std::size_t n) {
    std::vector<double> out(n);
    for (std::size_t i = 0; i < n; ++i)
        out[i] = amplitude *
                 std::cos(2.0 * std::numbers::pi * f * static_cast<double>(i) / kRate + phase);
    return out;
}

TEST(Spectra, LoneToneReadsItsAmplitudeAndFrequency) {
    for (const double f : {441.3, 1000.0, 12345.6}) {
        const Spectrum s(tone(f, 0.7, 0.3, 9000), kRate);
        const Peak top = s.strongest(20.0, 20000.0);
        EXPECT_NEAR(top.frequency, f, 0.01 * s.bin_width());
        EXPECT_NEAR(top.amplitude, 0.7, 0.7 * 2e-3);
    }
}

TEST(Spectra, WeakToneBesideAStrongOneIsFound) {
    std::vector<double> sum = tone(1000.0, 1.0, 0.0, 16384);
    const std::vector<double> weak = tone(1200.0, 1e-4, 1.0, 16384); // -80 dB
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += weak[i];
    const std::vector<Peak> found = Spectrum(sum, kRate).peaks(20.0, 20000.0, 2);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[1].frequency, 1200.0, 0.1);
    EXPECT_NEAR(found[1].amplitude, 1e-4, 1e-6);
}

TEST(Spectra, BandHoldsTheTonesPower) {
    const std::vector<double> x = tone(3000.0, 2.0, 0.1, 8192);
    EXPECT_NEAR(band_rms(x, kRate, 2000.0, 4000.0), std::numbers::sqrt2, 1e-6);
    EXPECT_LT(band_rms(x, kRate, 5000.0, 20000.0), 2e-5);
}

TEST(Spectra, PhasorHasAmplitudeAndPhase) {
    const std::complex<double> a = phasor(tone(777.7, 0.3, 1.1, 5000), kRate, 777.7);
    EXPECT_NEAR(std::abs(a), 0.3, 1e-12);
    EXPECT_NEAR(std::arg(a), 1.1, 1e-12);
}

TEST(Spectra, TooShortIsEmpty) {
    EXPECT_EQ(Spectrum(std::vector<double>(5, 1.0), kRate).peaks(0.0, kRate, 3).size(), 0u);
    EXPECT_EQ(band_rms(std::vector<double>(5, 1.0), kRate, 0.0, kRate), 0.0);
}

} // namespace
} // namespace ode::sound
