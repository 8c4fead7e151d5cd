#include "plots/spectrogram.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace {

std::vector<float> sine(double amplitude, double frequency, double rate, std::size_t count) {
    std::vector<float> x(count);
    for (std::size_t i = 0; i < count; ++i)
        x[i] = static_cast<float>(
            amplitude * std::sin(2 * std::numbers::pi * frequency * static_cast<double>(i) / rate));
    return x;
}

std::ptrdiff_t loudest(const plots::Spectrogram& s) {
    return std::max_element(s.level.begin(), s.level.end()) - s.level.begin();
}

TEST(Spectrum, SineReadsItsAmplitudeInItsBin) {
    const double rate = 48000;
    const double f = rate * 200 / 4096; // on a bin: no scalloping
    const plots::Spectrogram s = plots::spectrum(sine(0.1, f, rate, 4096), rate);
    EXPECT_EQ(loudest(s), 200);
    // Hann's own negative-frequency leakage is below 1e-6 here; single precision is about 1e-5 dB.
    EXPECT_NEAR(s.level[200], -20, 1e-3);
}

TEST(Spectrum, PaddingKeepsLevelAndFrequency) {
    const double rate = 48000;
    const plots::Spectrogram s = plots::spectrum(sine(1, 3000, rate, 5000), rate);
    EXPECT_EQ(s.rows, 8192 / 2 + 1);
    EXPECT_NEAR(static_cast<double>(loudest(s)) * s.row_height, 3000, s.row_height / 2);
    EXPECT_NEAR(s.level[static_cast<std::size_t>(loudest(s))], 0,
                0.6); // scalloping of 5000 in 8192
}

TEST(Spectrogram, ShowsWhenAndWhere) {
    const double rate = 48000;
    std::vector<float> x(24000, 0.0F);
    const std::vector<float> tone = sine(1, 6000, rate, 12000);
    std::copy(tone.begin(), tone.end(), x.begin() + 12000); // sounds from 0.25 s on
    const plots::Spectrogram s = plots::spectrogram(x, rate, 1024, 100);
    ASSERT_EQ(s.columns, 100);
    EXPECT_NEAR(s.column_width, 0.005, 1e-12);
    const auto level = [&](int column, double f) {
        const int row = static_cast<int>(std::lround(f / s.row_height));
        return s.level[static_cast<std::size_t>(row * s.columns + column)];
    };
    EXPECT_LT(level(40, 6000), -200);      // silence, window clear of the onset
    EXPECT_NEAR(level(60, 6000), 0, 1e-2); // 6000 Hz is bin 128
    EXPECT_LT(level(60, 12000), -80);      // Hann's far sidelobes
}

TEST(Spectrogram, SilenceAndNothingAreFinite) {
    for (const std::size_t n : {std::size_t{0}, std::size_t{10}}) {
        const std::vector<float> x(n, 0.0F);
        for (const float level : plots::spectrogram(x, 48000, 256, 4).level)
            EXPECT_TRUE(std::isfinite(level));
        for (const float level : plots::spectrum(x, 48000).level)
            EXPECT_TRUE(std::isfinite(level));
    }
}

} // namespace
