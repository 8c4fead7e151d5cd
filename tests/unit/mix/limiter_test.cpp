#include "mix/limiter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace ode::sound {
namespace {

constexpr int kRate = 48000;

std::vector<float> through(Limiter& limiter, const std::vector<float>& in) {
    std::vector<float> out = in;
    for (std::size_t i = 0; i < out.size(); i += 200) // blocks of 100 frames
        limiter.run(out.data() + i,
                    static_cast<int>(std::min<std::size_t>(100, (out.size() - i) / 2)));
    return out;
}

TEST(Limiter, QuietSoundPassesBitForBit) {
    Limiter limiter(kRate, 2, 0.9);
    std::vector<float> in;
    for (int i = 0; i < 4000; ++i)
        in.push_back(0.89F * std::sin(0.1F * static_cast<float>(i)));
    const std::vector<float> out = through(limiter, in);
    const auto delay = 2 * static_cast<std::size_t>(limiter.delay());
    EXPECT_EQ(limiter.delay(), 72); // 1.5 ms
    for (std::size_t i = delay; i < out.size(); ++i)
        EXPECT_EQ(out[i], in[i - delay]);
    EXPECT_EQ(limiter.take_least_gain(), 1.0);
}

TEST(Limiter, NothingExceedsTheCeilingAndEarsKeepTheirRatio) {
    Limiter limiter(kRate, 2, 0.9);
    std::vector<float> in;
    unsigned noise = 1;
    for (int i = 0; i < 20000; ++i) { // bursts of noise up to 20
        noise = noise * 1664525u + 1013904223u;
        const float x = static_cast<float>(noise >> 8) / 8388608.0F - 1.0F;
        const float loud = i % 5000 < 700 ? 20.0F : 0.1F;
        in.push_back(loud * x);
        in.push_back(0.5F * loud * x);
    }
    const std::vector<float> out = through(limiter, in);
    for (std::size_t i = 0; i < out.size(); i += 2) {
        ASSERT_LE(std::abs(out[i]), 0.9F + 1e-6F);
        ASSERT_NEAR(out[i + 1], 0.5F * out[i], 1e-6F);
    }
    EXPECT_LT(limiter.take_least_gain(), 0.06);
}

// The gain slides: a full-scale tone beyond the ceiling is not cut but turned down before it comes.
TEST(Limiter, GainMovesSmoothly) {
    Limiter limiter(kRate, 1, 0.5);
    std::vector<float> in(9600, 0.25F);
    std::fill(in.begin() + 4800, in.begin() + 4900, 2.0F);
    std::vector<float> out = in;
    limiter.run(out.data(), static_cast<int>(out.size()));
    const auto delay = static_cast<std::size_t>(limiter.delay());
    float steepest = 0.0F;
    for (std::size_t i = delay + 1; i < out.size(); ++i) {
        const float now = out[i] / in[i - delay], before = out[i - 1] / in[i - 1 - delay];
        steepest = std::max(steepest, std::abs(now - before));
    }
    EXPECT_LT(steepest, 1.05F * 0.75F / 72.0F); // from 1 to 0.25 along the look-ahead
    EXPECT_NEAR(out[delay + 4850], 0.5F, 1e-6F);
    EXPECT_NEAR(out.back(), 0.25F, 0.1F);
}

} // namespace
} // namespace ode::sound
