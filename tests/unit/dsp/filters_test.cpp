#include "dsp/dc_block.h"
#include "dsp/decimator.h"
#include "dsp/kaiser.h"
#include "dsp/splat_table.h"
#include "dsp/step_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cstdio>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace ode::sound {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

double decibel(double x) { return 20.0 * std::log10(x); }

TEST(Kaiser, BesselMeetsTables) {
    // Abramowitz & Stegun, table 9.8: e^-x I0(x).
    EXPECT_NEAR(bessel_i0(1.0) * std::exp(-1.0), 0.4657596076, 1e-10);
    EXPECT_NEAR(bessel_i0(5.0) * std::exp(-5.0), 0.1835408126, 1e-10);
    EXPECT_NEAR(bessel_i0(10.0) * std::exp(-10.0), 0.1278333372, 1e-10);
}

TEST(Kaiser, SincSlopeIsTheDerivative) {
    for (const double x : {-3.3, -0.5, 1e-6, 0.2, 1.0, 7.7}) {
        const double h = 1e-5; // error h^2 pi^3 / 6 / 5: 1e-9
        EXPECT_NEAR(sinc_slope(x), (sinc(x + h) - sinc(x - h)) / (2.0 * h), 2e-9);
    }
}

TEST(StepKernel, RisesFromZeroToOneSymmetrically) {
    const StepKernel& step = step_kernel();
    EXPECT_EQ(step(-StepKernel::kHalfWidth), 0.0);
    EXPECT_EQ(step(StepKernel::kHalfWidth), 1.0);
    EXPECT_EQ(step(-1e9), 0.0);
    EXPECT_EQ(step(1e9), 1.0);
    EXPECT_EQ(step(std::nan("")), 0.0);
    for (double x = 0.0; x < 7.0; x += 0.0137)
        EXPECT_NEAR(step(x) + step(-x), 1.0, 1e-12);
}

// Response of the impulse, step'(x): gain of a box is known, so differences over 1/8 sample do.
TEST(StepKernel, PassesAQuarterAndStopsThreeQuarters) {
    const StepKernel& step = step_kernel();
    const auto response = [&](double f) {
        std::complex<double> sum = 0.0;
        constexpr double h = 1.0 / 128.0;
        for (double x = -7.0; x < 7.0; x += h)
            sum += (step(x + h) - step(x)) * std::polar(1.0, -kTau * f * (x + 0.5 * h));
        const double box = std::numbers::pi * f * h;
        return std::abs(sum) / (std::sin(box) / box);
    };
    EXPECT_NEAR(response(1e-6), 1.0, 1e-9);
    EXPECT_NEAR(response(0.25), 1.0, 3e-5);
    for (double f = 0.75; f < 6.0; f += 0.01)
        EXPECT_LT(decibel(response(f)), -95.0) << f;
}

TEST(SplatTable, RowsSumToOneAndMirror) {
    const double* rows = splat_table().rows();
    constexpr int kTaps = SplatTable::kTaps, kPhases = SplatTable::kPhases;
    for (int p = 0; p <= kPhases; ++p) {
        double sum = 0.0;
        for (int j = 0; j < kTaps; ++j)
            sum += rows[p * kTaps + j];
        EXPECT_NEAR(sum, 1.0, 1e-14);
    }
    // A fraction f is the mirror image of 1 - f.
    for (int p = 0; p <= kPhases; ++p)
        for (int j = 0; j < kTaps; ++j)
            EXPECT_NEAR(rows[p * kTaps + j], rows[(kPhases - p) * kTaps + kTaps - 1 - j], 1e-12);
}

/// A tap for a fraction of a sample, as many arrivals are summed for it.
double tap_of_moments(double fraction, int j) {
    double tap = 0.0;
    for (int m = SplatTable::kMoments - 1; m >= 0; --m)
        tap = tap * (fraction - 0.5) + splat_table().moments()[m * SplatTable::kTaps + j];
    return tap;
}

// Tones up to 20 kHz, put between the samples of the grid by any fraction: what is missing of them,
// and what is heard besides. A steady flow is right to rounding: its images are farthest down.
TEST(SplatTable, MomentsPutTonesWhereRowsDo) {
    double worst = 0.0, steady = 0.0;
    for (double fraction = 0.0; fraction <= 1.0; fraction += 0.01)
        for (double f = 0.0; f < 0.2084; f += 0.0104) {
            std::complex<double> rows, moments;
            for (int j = 0; j < SplatTable::kTaps; ++j) {
                const auto turn = std::polar(1.0, -kTau * f * (j - SplatTable::kBefore - fraction));
                const double place = fraction * SplatTable::kPhases;
                const int p = std::min(static_cast<int>(place), SplatTable::kPhases - 1);
                const double* row = splat_table().rows() + p * SplatTable::kTaps;
                rows += turn * (row[j] + (place - p) * (row[SplatTable::kTaps + j] - row[j]));
                moments += turn * tap_of_moments(fraction, j);
            }
            worst = std::max(worst, std::abs(moments - rows));
            steady = f == 0.0 ? std::max(steady, std::abs(moments - 1.0)) : steady;
        }
    std::printf("summed before it is spread: %.1f dB off, steady flow %.1f dB\n",
                20.0 * std::log10(worst), 20.0 * std::log10(steady));
    EXPECT_LT(worst, 1e-5);
    EXPECT_LT(steady, 1e-12); // powers of eight points, multiplied out
}

/// Output amplitude for an input e^{iwt} of frequency f.
std::complex<double> respond(const Decimator& decimator, double input_rate, double f) {
    const int n = 2 * decimator.reach() + 1;
    std::vector<double> re(static_cast<std::size_t>(n) + 3, 0.0), im(re);
    for (int i = 0; i < n; ++i) {
        const double phase = kTau * f / input_rate * (i - decimator.reach());
        re[static_cast<std::size_t>(i)] = std::cos(phase);
        im[static_cast<std::size_t>(i)] = std::sin(phase);
    }
    return {decimator(re.data()), decimator(im.data())};
}

class DecimatorAt : public testing::TestWithParam<double> {};

TEST_P(DecimatorAt, IsFlatThenSilent) {
    const double rate = GetParam();
    const Decimator smooth(rate, Decimator::Kind::kSmooth, 1.0);
    const Decimator slope(rate, Decimator::Kind::kDerivative, 1.0);
    EXPECT_NEAR(respond(smooth, 2.0 * rate, 0.0).real(), 1.0, 1e-12);
    EXPECT_NEAR(respond(slope, 2.0 * rate, 0.0).real(), 0.0, 1e-7);
    for (double f = 20.0; f <= Decimator::pass_edge(rate); f *= 1.1) {
        EXPECT_NEAR(decibel(std::abs(respond(smooth, 2.0 * rate, f))), 0.0, 0.001) << f;
        const std::complex<double> d = respond(slope, 2.0 * rate, f) / (kTau * f);
        EXPECT_NEAR(d.imag(), 1.0, 0.002) << f; // derivative of e^{iwt} is i w e^{iwt}
        EXPECT_NEAR(d.real(), 0.0, 1e-6) << f;
    }
    // Against a tone of the same pressure in the pass band.
    const double top = kTau * Decimator::pass_edge(rate);
    for (double f = Decimator::stop_edge(rate); f <= rate; f += 100.0) {
        EXPECT_LT(decibel(std::abs(respond(smooth, 2.0 * rate, f))), -99.0) << f;
        EXPECT_LT(decibel(std::abs(respond(slope, 2.0 * rate, f)) / top), -99.0) << f;
    }
    EXPECT_EQ(smooth.reach(), Decimator::reach_for(rate));
}

INSTANTIATE_TEST_SUITE_P(Rates, DecimatorAt, testing::Values(16000.0, 44100.0, 48000.0, 96000.0));

// H(z) = (1 - 1/z) / (1 - 0.9/z), P01 eq. 9.
TEST(DcBlock, IsEquationNine) {
    DcBlock block;
    const double f = 0.02;
    std::complex<double> expected = 1.0 - std::polar(1.0, -kTau * f);
    expected /= 1.0 - 0.9 * std::polar(1.0, -kTau * f);
    double top = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double y = block(std::cos(kTau * f * i));
        if (i > 1000)
            top = std::max(top, std::abs(y - (expected * std::polar(1.0, kTau * f * i)).real()));
    }
    EXPECT_LT(top, 1e-12);
}

} // namespace
} // namespace ode::sound
