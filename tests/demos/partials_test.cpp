#include "plots/partials.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace {

constexpr double kRate = 48000;

/// Decaying partials over a little noise, half a second.
std::vector<float> ring(const std::vector<double>& frequencies) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 1e-5);
    std::vector<float> x(24000);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double t = static_cast<double>(i) / kRate;
        double sum = noise(random);
        for (const double f : frequencies)
            sum += std::exp(-8 * t) * std::sin(2 * std::numbers::pi * f * t);
        x[i] = static_cast<float>(sum);
    }
    return x;
}

TEST(Partials, AreMeasuredToAThirdOfACent) {
    const std::vector<double> sounding = {1503.3, 4211.7, 9050.1};
    const std::vector<double> predicted = {1500, 4220, 9050};
    const auto found = plots::find_partials(ring(sounding), kRate, predicted);
    ASSERT_EQ(found.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(found[i].predicted, predicted[i]);
        // 0.02 bins of 1.46 Hz, and as much again for the decay's tail under the next line.
        EXPECT_NEAR(1200 * std::log2(found[i].measured / sounding[i]), 0, 0.3);
    }
}

TEST(Partials, WhatDoesNotSoundIsNotFound) {
    const std::vector<double> predicted = {1500, 3000, 9050};
    const auto found = plots::find_partials(ring({1500}), kRate, predicted);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].predicted, 1500);
}

TEST(Partials, ALineBeyondReachIsNotTaken) {
    EXPECT_TRUE(plots::find_partials(ring({1600}), kRate, std::vector<double>{1500}).empty());
}

TEST(Partials, ALineBelongsToTheNearestPrediction) {
    const std::vector<double> predicted = {1490, 1499, 1520};
    const auto found = plots::find_partials(ring({1500}), kRate, predicted);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].predicted, 1499);
}

TEST(Partials, SilenceHasNone) {
    const std::vector<float> silence(1000, 0.0F);
    EXPECT_TRUE(plots::find_partials(silence, kRate, std::vector<double>{1500}).empty());
    EXPECT_TRUE(plots::find_partials({}, kRate, std::vector<double>{1500}).empty());
}

} // namespace
