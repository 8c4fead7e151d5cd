// The mode bank's kernels against double precision, for every instruction set.
#include "dsp/kernels.h"
#include "dsp/storage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ode::sound {
namespace {

constexpr int kColumns = 5 * kModeLanes, kSamples = 24; // not a whole number of register groups

AlignedFloats random_row(std::mt19937& random, std::size_t n) {
    std::uniform_real_distribution<float> any(-1.0f, 1.0f);
    AlignedFloats out(n);
    for (float& x : out)
        x = any(random);
    return out;
}

// Each step rounds by 2^-24 of what it adds up; 24 of them by no more than 1e-5.
TEST(ModeBank, RingsAsTheRecurrenceSays) {
    for (const Kernels* set : all_kernels()) {
        std::mt19937 random(1);
        constexpr int kStride = kColumns + kModeLanes; // rows of the step may be longer
        const AlignedFloats step = random_row(random, 4 * kStride);
        AlignedFloats scaled = step;
        for (float& x : scaled)
            x *= 0.1f;
        AlignedFloats q = random_row(random, kColumns), v = random_row(random, kColumns);
        std::vector<double> x(q.begin(), q.end()), y(v.begin(), v.end());
        AlignedFloats q_rows(kColumns * kSamples), v_rows(kColumns * kSamples);
        set->ring(kColumns, kSamples, scaled.data(), kStride, q.data(), v.data(), q_rows.data(),
                  v_rows.data());
        for (std::size_t s = 0; s < kSamples; ++s)
            for (std::size_t k = 0; k < kColumns; ++k) {
                const auto by = [&](std::size_t r) {
                    return static_cast<double>(scaled[r * kStride + k]);
                };
                const double next = x[k] + by(0) * x[k] + by(1) * y[k];
                y[k] = y[k] + by(2) * x[k] + by(3) * y[k];
                x[k] = next;
                const double size = 1.0 + std::hypot(x[k], y[k]);
                ASSERT_NEAR(static_cast<double>(q_rows[s * kColumns + k]), x[k], 1e-5 * size)
                    << set->name;
                ASSERT_NEAR(static_cast<double>(v_rows[s * kColumns + k]), y[k], 1e-5 * size)
                    << set->name;
            }
        EXPECT_EQ(q[7], q_rows[(kSamples - 1) * kColumns + 7]);
        EXPECT_EQ(v[7], v_rows[(kSamples - 1) * kColumns + 7]);
    }
}

TEST(ModeBank, WeighsEachEar) {
    for (const Kernels* set : all_kernels()) {
        std::mt19937 random(2);
        const AlignedFloats q = random_row(random, kColumns * kSamples),
                            v = random_row(random, kColumns * kSamples);
        AlignedFloats weight[4][2];
        const float* by[4][2];
        for (int e = 0; e < 4; ++e)
            for (int i = 0; i < 2; ++i) {
                weight[e][i] = random_row(random, kColumns);
                by[e][i] = weight[e][i].data();
            }
        for (const int ears : {1, 2, 4}) {
            float heard[4][kSamples];
            float* const out[4] = {heard[0], heard[1], heard[2], heard[3]};
            set->weigh(kColumns, kSamples, ears, by, q.data(), v.data(), out);
            for (int e = 0; e < ears; ++e)
                for (std::size_t s = 0; s < kSamples; ++s) {
                    double sum = 0.0;
                    for (std::size_t k = 0; k < kColumns; ++k)
                        sum += static_cast<double>(by[e][0][k]) *
                                   static_cast<double>(q[s * kColumns + k]) +
                               static_cast<double>(by[e][1][k]) *
                                   static_cast<double>(v[s * kColumns + k]);
                    ASSERT_NEAR(static_cast<double>(heard[e][s]), sum, 2e-5) << set->name;
                }
        }
    }
}

TEST(ModeBank, IsPushedAfterEachStep) {
    for (const Kernels* set : all_kernels()) {
        std::mt19937 random(3);
        AlignedFloats step = random_row(random, 4 * kColumns);
        for (float& x : step)
            x *= 0.1f;
        AlignedFloats q = random_row(random, kColumns), v = random_row(random, kColumns);
        AlignedFloats q_own = q, v_own = v, row[2];
        const AlignedFloats push[3] = {random_row(random, kColumns), random_row(random, kModeLanes),
                                       random_row(random, kModeLanes)};
        AlignedFloats series[2] = {random_row(random, kSamples), random_row(random, kSamples)};
        series[0][3] = 0.0f;
        const RingPush given[2] = {
            {series[0].data(), nullptr, push[0].data(), kColumns, 0, kSamples},
            {series[1].data(), push[1].data(), push[2].data(), kModeLanes, 2, kSamples - 1}};
        series[1].front() = series[1][1] = series[1].back() = 0.0f;
        AlignedFloats q_rows(kColumns * kSamples), v_rows(kColumns * kSamples);
        row[0].resize(kColumns);
        row[1].resize(kColumns);
        set->ring_pushed(kColumns, kSamples, step.data(), kColumns, q.data(), v.data(),
                         q_rows.data(), v_rows.data(), given, 2);
        for (std::size_t s = 0; s < kSamples; ++s) {
            set->ring(kColumns, 1, step.data(), kColumns, q_own.data(), v_own.data(), row[0].data(),
                      row[1].data());
            for (std::size_t k = 0; k < kColumns; ++k)
                v_own[k] += series[0][s] * push[0][k];
            for (std::size_t k = 0; k < kModeLanes; ++k) {
                q_own[k] += series[1][s] * push[1][k];
                v_own[k] += series[1][s] * push[2][k];
            }
        }
        for (std::size_t k = 0; k < kColumns; ++k) {
            const float size = 1.0f + std::hypot(q_own[k], v_own[k]);
            EXPECT_NEAR(q[k], q_own[k], 1e-5f * size) << set->name;
            EXPECT_NEAR(v[k], v_own[k], 1e-5f * size) << set->name;
        }
    }
}

} // namespace
} // namespace ode::sound
