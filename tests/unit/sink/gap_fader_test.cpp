#include "signals.h"
#include "sink/gap_fader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ode::sound {
namespace {

constexpr std::size_t kBlock = 256;

/// What is heard of `stream` when blocks [from, to) of the output get nothing.
std::vector<float> with_gap(const std::vector<float>& stream, std::size_t blocks, std::size_t from,
                            std::size_t to) {
    GapFader fader(2);
    std::vector<float> heard;
    std::vector<float> block(2 * kBlock);
    auto next = stream.begin();
    for (std::size_t i = 0; i < blocks; ++i) {
        const bool missing = i >= from && i < to;
        if (!missing) {
            std::copy_n(next, 2 * kBlock, block.begin());
            next += 2 * kBlock;
        }
        fader.fill(block, missing ? 0 : kBlock);
        heard.insert(heard.end(), block.begin(), block.end());
    }
    return heard;
}

TEST(GapFader, PassesBitsOutsideOfGaps) {
    const auto x = test::noise(2 * kBlock * 20);
    EXPECT_EQ(with_gap(x, 20, 20, 20), x);
}

TEST(GapFader, LosesNothingAndReturnsToBits) {
    const auto x = test::noise(2 * kBlock * 40);
    const auto heard = with_gap(x, 45, 10, 15);
    EXPECT_TRUE(std::equal(x.begin(), x.begin() + 2 * kBlock * 10, heard.begin()));
    const auto after = heard.begin() + 2 * kBlock * 15 + 2 * GapFader::kFade;
    const auto source = x.begin() + 2 * kBlock * 10 + 2 * GapFader::kFade;
    EXPECT_TRUE(std::equal(after, heard.end(), source));
}

// Long and short gaps: the short one ends before its bridge does.
TEST(GapFader, FullScaleConstantMakesNoStepAboveMinus60dB) {
    const std::vector<float> x(2 * kBlock * 40, 1.0F);
    for (const std::size_t length : {1U, 4U, 12U}) {
        const auto heard = with_gap(x, 30, 10, 10 + length);
        EXPECT_LT(test::step(heard), test::kMinus60dB) << length;
        EXPECT_GT(test::step(heard), 0) << "a gap that cannot be told is no gap";
    }
}

// A tone goes on into the gap. Held instead, it would break off with a kink of A omega: -31 dBFS
// here at 440 Hz, -9 dBFS at 5 kHz.
TEST(GapFader, ToneBreaksOffWithoutClick) {
    for (const double frequency : {50.0, 440.0, 5000.0, 15000.0}) {
        const double omega = test::omega_of(frequency, 48000);
        const auto x = test::sine(kBlock * 40, omega, 0.5);
        for (const std::size_t length : {1U, 12U}) {
            const auto heard = with_gap(x, 30, 10, 10 + length);
            const auto until_return = std::vector<float>(
                heard.begin(),
                heard.begin() + static_cast<std::ptrdiff_t>(2 * kBlock * (10 + length)));
            EXPECT_LT(test::click(until_return, omega), test::kMinus60dB) << frequency;
            EXPECT_LT(test::click(heard, omega), test::kMinus60dB) << frequency;
        }
    }
}

TEST(GapFader, LongGapFadesToExactSilence) {
    const auto heard = with_gap(test::noise(2 * kBlock * 10), 30, 10, 30);
    const auto faded = heard.begin() + 2 * kBlock * 10 + 2 * GapFader::kFade;
    EXPECT_THAT(std::vector<float>(faded, heard.end()), testing::Each(0.0F));
    EXPECT_NE(*(faded - 2 * GapFader::kFade), 0.0F);
}

TEST(GapFader, BridgeIsNeverLouderThanWhatWasHeard) {
    std::vector<float> rising(2 * kBlock * 10); // its prediction grows without bound
    for (std::size_t i = 0; i < rising.size(); ++i)
        rising[i] = std::exp(0.002F * (static_cast<float>(i / 2) - kBlock * 10));
    const auto heard = with_gap(rising, 30, 10, 30);
    EXPECT_LE(*std::max_element(heard.begin(), heard.end()), rising.back());
}

TEST(GapFader, ManyGapsInARowStaySmooth) {
    const double omega = test::omega_of(440, 48000);
    const auto x = test::sine(kBlock * 60, omega, 0.5);
    GapFader fader(2);
    std::vector<float> heard;
    std::vector<float> block(2 * kBlock);
    auto next = x.begin();
    for (int i = 0; i < 99; ++i) { // slower than real time by two fifths: 154 of 256 frames come
        std::copy_n(next, 2 * 154, block.begin());
        next += 2 * 154;
        fader.fill(block, 154);
        heard.insert(heard.end(), block.begin(), block.end());
    }
    // Gaps begin within fades here. A prediction averages over 32 frames, so where its start is
    // being faded it misses by up to 16 times the slope: 16 * 7.7e-4 * 0.5.
    EXPECT_LT(test::click(heard, omega), 6.2e-3);
    EXPECT_LE(*std::max_element(heard.begin(), heard.end()), 0.5F);
}

} // namespace
} // namespace ode::sound
