// What slides and rolls: heights read at the speed of slip, forces that the load limits.
#include "strike/hertz.h"
#include "strike/scrape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kRate = 48000.0, kTau = 2.0 * std::numbers::pi;

std::shared_ptr<const Roughness> waves(double height, double length) {
    constexpr std::size_t kPoints = 64;
    std::vector<double> h(kPoints);
    for (std::size_t i = 0; i < kPoints; ++i)
        h[i] = height * std::sin(kTau * static_cast<double>(i) / kPoints);
    return std::make_shared<const Roughness>(h, length / kPoints);
}
const auto kFlat = std::make_shared<const Roughness>(std::vector<double>(8, 0.0), 1e-3);

double line(const std::vector<float>& f, double frequency) {
    std::complex<double> sum = 0;
    const auto n = static_cast<double>(f.size());
    for (std::size_t i = 0; i < f.size(); ++i)
        sum += static_cast<double>(f[i]) * (1 - std::cos(kTau * static_cast<double>(i) / n)) *
               std::polar(1.0, -kTau * frequency * static_cast<double>(i) / kRate);
    return 2 * std::abs(sum) / n;
}

std::vector<float> force(Scrape& scrape, const ScrapeAim& aim, int samples) {
    std::vector<float> out(static_cast<std::size_t>(samples));
    scrape.aim(aim);
    scrape.run(samples, out.data()); // the load comes
    scrape.aim(aim);
    scrape.run(samples, out.data());
    return out;
}

TEST(Roughness, HasItsHeightAndItsSpectrum) {
    const Texture texture{2e-6, 5e-3, 5e-5, 7};
    const Roughness rough(texture), same(texture);
    double square = 0, fine = 0, coarse = 0;
    constexpr int kPoints = 200000;
    for (int i = 0; i < kPoints; ++i) {
        const double x = i * rough.period() / kPoints;
        ASSERT_EQ(rough.mean(x, 0), same.mean(x, 0)) << "the same every time";
        square += std::pow(rough.mean(x, 0), 2) / kPoints;
        // Differences over s of a surface of power k^-2 grow as its root.
        fine += std::pow(rough.mean(x + 2e-4, 0) - rough.mean(x, 0), 2);
        coarse += std::pow(rough.mean(x + 4e-4, 0) - rough.mean(x, 0), 2);
    }
    EXPECT_NEAR(std::sqrt(square), 2e-6, 0.05 * 2e-6);
    // 1 - exp(-2 pi s / longest), the correlation that such a spectrum has.
    const double expected =
        (1 - std::exp(-kTau * 4e-4 / 5e-3)) / (1 - std::exp(-kTau * 2e-4 / 5e-3));
    EXPECT_NEAR(coarse / fine, expected, 0.05 * expected);
    EXPECT_NEAR(rough.mean(0.1, 0), rough.mean(0.1 + rough.period(), 0), 1e-15);
}

TEST(Roughness, IsAMeanOverTheWidth) {
    const auto wave = waves(1e-6, 1e-2);
    for (const double width : {1e-3, 5e-3, 1e-2})
        EXPECT_NEAR(wave->mean(2.5e-3, width),
                    1e-6 * std::sin(std::numbers::pi * width / 1e-2) /
                        (std::numbers::pi * width / 1e-2),
                    5e-9); // 64 steps a wave
}

// Waves of 2 mm passed at 1 m/s: 500 Hz, and the force on a mass on a spring that is moved so.
TEST(Scrape, SoundsAtSpeedOverWavelength) {
    const double height = 1e-9, k = 1e6, m = 0.02, damping = 0.05;
    for (const double speed : {0.4, 1.0, 3.0}) {
        Scrape scrape({kFlat, waves(height, 2e-3)}, kRate);
        const std::vector<float> f = force(scrape, {5.0, {0.0, speed}, k, 0.0, m, damping}, 48000);
        const double w = kTau * speed / 2e-3, w0 = std::sqrt(k / m);
        const std::complex<double> i(0, 1);
        const double expected =
            k * height * std::abs(-w * w / (w0 * w0 - w * w + 2. * i * damping * w * w0));
        const double heard = line(f, speed / 2e-3);
        EXPECT_NEAR(heard, expected, 0.02 * expected) << speed;
        for (const double off : {0.7, 1.3})
            EXPECT_LT(line(f, off * speed / 2e-3), 0.01 * heard) << speed;
    }
}

TEST(Scrape, NeverOutdoesTheLoad) {
    const auto rough = std::make_shared<const Roughness>(Texture{1e-4, 5e-3, 5e-5, 3});
    Scrape scrape({rough, rough}, kRate);
    const std::vector<float> f = force(scrape, {0.3, {0.2, 2.0}, 1e7, 1e-5, 0.05, 0.05}, 48000);
    const float most = *std::max_element(f.begin(), f.end());
    const float least = *std::min_element(f.begin(), f.end());
    EXPECT_GT(most, 0.28f);
    EXPECT_LE(most, 0.3f);
    EXPECT_GE(least, -0.3f) << "bodies don't pull";
}

TEST(Scrape, IsSilentAtRestAndGoesOffSteadily) {
    const auto rough = std::make_shared<const Roughness>(Texture{});
    Scrape scrape({rough, rough}, kRate);
    std::vector<float> f = force(scrape, {1.0, {0.0, 0.5}, 1e6, 1e-5, 0.05, 0.1}, 4800);
    EXPECT_GT(*std::max_element(f.begin(), f.end()), 1e-4f);
    f = force(scrape, {1.0, {0.0, 0.0}, 1e6, 1e-5, 0.05, 0.1}, 48000);
    EXPECT_LT(std::fabs(f.back()), 1e-9f);
    scrape.release();
    scrape.run(480, f.data());
    EXPECT_LT(std::fabs(f[479]), 1e-12f) << "rounding of the ramp";
}

// K. L. Johnson, Contact Mechanics, 4.2: depth a^2 / R, a^3 = 3 F R / (4 E*).
TEST(Scrape, StiffnessIsTheSlopeOfHertzsLaw) {
    const double modulus = 5e10, curvature = 100.0;
    const auto depth = [&](double load) {
        const double a = bearing_radius(load, curvature, modulus);
        return a * a * curvature;
    };
    EXPECT_NEAR(bearing_stiffness(2.0, curvature, modulus), 2e-4 / (depth(2.0001) - depth(1.9999)),
                1e-4 * bearing_stiffness(2.0, curvature, modulus));
    // F = 4/3 E* sqrt(R) depth^(3/2)
    EXPECT_NEAR(4.0 / 3 * modulus * std::sqrt(1 / curvature) * std::pow(depth(2.0), 1.5), 2.0,
                1e-9);
}

// A marble of 5 g that rolls on glass at 0.5 m/s keeps to it: with the default texture its force is
// mostly below the load, with the heights of ground metal it would leap.
TEST(Scrape, AMarbleDoesNotLeapByDefault) {
    const double modulus = 62e9 / (2 * (1 - 0.2 * 0.2)), load = 0.005 * 9.81;
    const auto leaps = [&](double roughness) {
        Texture texture;
        if (roughness > 0)
            texture.roughness = roughness;
        Texture other = texture;
        other.seed = 2;
        Scrape scrape(
            {std::make_shared<const Roughness>(texture), std::make_shared<const Roughness>(other)},
            kRate);
        const ScrapeAim aim{load,
                            {0.5, 0.5},
                            bearing_stiffness(load, 125, modulus),
                            bearing_radius(load, 125, modulus),
                            0.005,
                            0.1};
        const std::vector<float> f = force(scrape, aim, 48000);
        // 0.7 of the load is where the law has halved its slope and more.
        return static_cast<double>(std::count_if(
                   f.begin(), f.end(),
                   [&](float x) { return std::fabs(static_cast<double>(x)) > 0.7 * load; })) /
               static_cast<double>(f.size());
    };
    const double polished = leaps(0), ground = leaps(0.5e-6);
    std::printf("at the limit of its load: %.1f %% of the time, ground %.1f %%\n", 100 * polished,
                100 * ground);
    EXPECT_LT(polished, 0.25);
    EXPECT_GT(ground, 0.5);
}

} // namespace
} // namespace ode::sound
