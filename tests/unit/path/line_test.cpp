#include "dsp/splat_table.h"
#include "path/ear_line.h"
#include "path/paper_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ode::sound {
namespace {

constexpr double kRate = 48000.0;

/// Sends a unit flow from the origin at a grid sample to an ear `distance` grid samples of sound
/// away. @return whether it was kept.
bool send(EarLine& line, std::int64_t sample, double distance) {
    const double position[16] = {};
    const double softening[4] = {1e-12, 1e-12, 1e-12, 1e-12};
    const double flow[4] = {distance, 0.0, 0.0, 0.0}; // times 1 / distance: lands as 1
    SplatEar ear = line.target(sample);
    ear.gain = 1.0;
    ear.position[0] = distance;
    const SplatSurface surface{4,
                               position,
                               nullptr,
                               softening,
                               flow,
                               nullptr,
                               nullptr,
                               1.0,
                               splat_table().rows(),
                               splat_table().moments()};
    const double last = kernels().splat[0](surface, &ear, 1);
    line.note_arrival(static_cast<double>(sample) + last);
    return last > 0.0;
}

double centroid(const std::vector<double>& out) {
    double moment = 0.0;
    for (std::size_t i = 0; i < out.size(); ++i)
        moment += static_cast<double>(i) * out[i];
    return moment / std::accumulate(out.begin(), out.end(), 0.0);
}

TEST(EarLine, ReadsAtTheTimeOfArrival) {
    for (const double distance : {10.0, 123.25, 1000.75}) {
        EarLine line(kRate, 0, Decimator(kRate, Decimator::Kind::kSmooth, 1.0), std::nullopt);
        ASSERT_TRUE(send(line, 200, distance));
        std::vector<double> out(static_cast<std::size_t>(line.last_frame()) + 1);
        line.read(static_cast<int>(out.size()), out.data());
        // A sample of the grid is half an audio frame long.
        EXPECT_NEAR(std::accumulate(out.begin(), out.end(), 0.0), 0.5, 1e-5);
        EXPECT_NEAR(centroid(out), 0.5 * (200.0 + distance), 0.01);
        double more[8];
        line.read(8, more);
        for (const double v : more)
            EXPECT_EQ(v, 0.0) << "nothing behind last_frame()";
    }
}

TEST(EarLine, BlocksOfAnySizeGiveTheSameBits) {
    const Decimator decimator(kRate, Decimator::Kind::kDerivative, 1.0);
    EarLine one(kRate, 0, decimator, DcBlock{}), many(kRate, 0, decimator, DcBlock{});
    send(one, 200, 55.5);
    send(many, 200, 55.5);
    std::vector<double> a(700), b(700);
    one.read(700, a.data());
    for (int at = 0, n = 1; at < 700; at += n, n = std::min(n % 97 + 13, 700 - at))
        many.read(n, b.data() + at);
    EXPECT_EQ(a, b);
}

TEST(EarLine, RingMayGoRoundManyTimes) {
    EarLine line(kRate, 0, Decimator(kRate, Decimator::Kind::kSmooth, 1.0), std::nullopt);
    const std::int64_t cells = line.target(0).mask + 1;
    std::vector<double> out(1000);
    for (std::int64_t frame = 0; frame < 2 * cells; frame += 1000) {
        // One wave in each thousand frames, wherever that falls in the ring.
        ASSERT_TRUE(send(line, 2 * frame + 400, 600.0));
        line.read(1000, out.data());
        ASSERT_NEAR(std::accumulate(out.begin(), out.end(), 0.0), 0.5, 1e-5) << frame;
    }
}

TEST(EarLine, TooLateAndTooFarIsDropped) {
    EarLine line(kRate, 1000, Decimator(kRate, Decimator::Kind::kSmooth, 1.0), std::nullopt);
    EXPECT_FALSE(send(line, 100, 10.0));
    EXPECT_FALSE(send(line, 2000, 3.0 * 2.0 * kRate * kLongestDelay));
    std::vector<double> out(3000);
    line.read(3000, out.data());
    EXPECT_EQ(*std::max_element(out.begin(), out.end()), 0.0);
}

// Gaussian of sigma half a sample, unnormalised: P01 3.3.
TEST(PaperLine, SplatsAGaussian) {
    PaperLine line(kRate, 0, 2.0, false);
    line.add(5, 10.25, 3.0);
    double out[20];
    line.read(20, out);
    const double peak = 3.0 * 2.0 * std::sqrt(2.0 / std::acos(-1.0));
    for (int i = 0; i < 20; ++i) {
        const double x = i - 15.25;
        EXPECT_NEAR(out[i], i >= 14 && i <= 17 ? peak * std::exp(-2.0 * x * x) : 0.0, 1e-12);
    }
}

TEST(PaperLine, DifferenceIsTheDerivative) {
    PaperLine line(kRate, 0, 1.0, true);
    line.add(0, 3.0, 1.0);
    double out[8];
    line.read(8, out);
    EXPECT_GT(out[3], 0.0);
    EXPECT_NEAR(out[3], kRate * std::sqrt(2.0 / std::acos(-1.0)) * (1.0 - std::exp(-2.0)), 1e-6);
    EXPECT_NEAR(out[4], -out[3], 1e-6);
}

TEST(PaperLine, BadValuesAreDropped) {
    PaperLine line(kRate, 10, 1.0, false);
    line.add(20, std::nan(""), 1.0);
    line.add(20, 5.0, HUGE_VAL);
    line.add(20, -5.0, 1.0);
    line.add(20, 1e12, 1.0);
    line.add(2, 1.0, 1.0);
    double out[64];
    line.read(64, out);
    for (const double v : out)
        EXPECT_EQ(v, 0.0);
    EXPECT_EQ(line.last_frame(), 10);
}

} // namespace
} // namespace ode::sound
