// Contact times, force pulses and struck surfaces against closed forms.
#include "strike/hertz.h"
#include "strike/pulse.h"
#include "strike/struck_surface.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

namespace ode::sound {
namespace {

// A steel ball of 1 cm on steel at 1 m/s: m = 32.9 g, E* = 110 GPa; Hertz's own equation of motion,
// m x'' = -4/3 E* sqrt(R) x^(3/2), integrated.
TEST(Strike, TakesHertzsTime) {
    const double radius = 0.01, mass = 4.0 / 3 * std::numbers::pi * 1e-6 * 7850;
    const Elastic steel{200e9, 0.29};
    const double modulus = contact_modulus(steel, steel);
    EXPECT_NEAR(modulus, 200e9 / (2 * (1 - 0.29 * 0.29)), 1);
    double x = 0, v = 1, t = 0;
    for (const double dt = 1e-9; x >= 0; t += dt) {
        v -= dt * 4.0 / 3 * modulus * std::sqrt(radius) * std::pow(std::max(x, 0.0), 1.5) / mass;
        x += dt * v;
    }
    EXPECT_NEAR(contact_time(mass, 1 / radius, modulus, 1) / t, 1, 0.005);
    EXPECT_EQ(contact_time(mass, 1 / radius, modulus, 0), kLongest);
    EXPECT_EQ(contact_time(1e-12, 1e6, modulus, 1e3), kShortest);
}

TEST(Strike, GivesAllOfItsImpulseAndNoneTwice) {
    EXPECT_EQ(pulse_share(-1), 0);
    EXPECT_EQ(pulse_share(0), 0);
    EXPECT_EQ(pulse_share(1), 1);
    EXPECT_NEAR(pulse_share(0.5), 0.5, 1e-9);
    for (double u = 0.001; u < 1; u += 0.001)
        EXPECT_GT(pulse_share(u), pulse_share(u - 0.001));
    // Integral of sin^(3/2)(pi u) from 0 to 1: Gamma(5/4) / (sqrt(pi) Gamma(7/4)).
    const double all = std::tgamma(1.25) / (std::sqrt(std::numbers::pi) * std::tgamma(1.75));
    const double force = (pulse_share(0.3 + 1e-4) - pulse_share(0.3 - 1e-4)) / 2e-4;
    EXPECT_NEAR(force, std::pow(std::sin(0.3 * std::numbers::pi), 1.5) / all, 1e-5);
}

TEST(Strike, IsFeltAsItsSpectrumSays) {
    EXPECT_NEAR(pulse_spectrum(0), 1, 1e-9);
    for (const double x : {1.0, 5.0, 20.0}) { // straight lines between entries err by 1e-4
        double c = 0, s = 0;
        for (int i = 0; i < 10000; ++i) {
            const double u = (i + 0.5) / 10000;
            const double part = pulse_share(u + 5e-5) - pulse_share(u - 5e-5);
            c += part * std::cos(x * u), s += part * std::sin(x * u);
        }
        EXPECT_NEAR(pulse_spectrum(x), std::hypot(c, s), 1e-3) << x;
    }
}

/// A ball of triangles: an octahedron cut in four `cuts` times.
StruckSurface ball(double radius, int cuts, std::vector<Vec3>* nodes = nullptr) {
    std::vector<Vec3> node = {Vec3::UnitX(),  Vec3::UnitY(),  Vec3::UnitZ(),
                              -Vec3::UnitX(), -Vec3::UnitY(), -Vec3::UnitZ()};
    std::vector<std::array<int, 3>> triangle;
    for (int a : {0, 3})
        for (int b : {1, 4})
            for (int c : {2, 5}) {
                const auto at = [&](int i) { return node[static_cast<std::size_t>(i)]; };
                const bool out = at(a).cross(at(b)).dot(at(c)) > 0;
                triangle.push_back(out ? std::array{a, b, c} : std::array{a, c, b});
            }
    for (int cut = 0; cut < cuts; ++cut) {
        std::vector<std::array<int, 3>> finer;
        for (const auto& t : triangle) {
            int mid[3];
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 x = (node[static_cast<std::size_t>(t[i])] +
                                node[static_cast<std::size_t>(t[(i + 1) % 3])])
                                   .normalized();
                mid[i] = -1;
                for (std::size_t n = 0; n < node.size(); ++n)
                    if ((node[n] - x).norm() < 1e-9)
                        mid[i] = static_cast<int>(n);
                if (mid[i] < 0) {
                    mid[i] = static_cast<int>(node.size());
                    node.push_back(x);
                }
            }
            finer.insert(finer.end(), {{t[0], mid[0], mid[2]},
                                       {mid[0], t[1], mid[1]},
                                       {mid[2], mid[1], t[2]},
                                       {mid[0], mid[1], mid[2]}});
        }
        triangle = finer;
    }
    for (Vec3& x : node)
        x *= radius;
    // One mode, whose shape is the place itself.
    std::vector<double> shape;
    for (const Vec3& x : node)
        shape.insert(shape.end(), x.data(), x.data() + 3);
    if (nodes)
        *nodes = node;
    return StruckSurface(node, triangle, shape);
}

/// By how much what a mode keeps of a pulse, told sample by sample, errs at worst [of the longest
/// possible], wherever in a sample it begins: images of the force beyond half the rate.
double image(double duration, double frequency) {
    constexpr double kRate = 48000.0, kPi = std::numbers::pi;
    const double w = 2 * kPi * frequency, half = 0.5 * w / kRate;
    double worst = 0.0;
    for (int phase = 0; phase < 16; ++phase) {
        const double begin = phase / 16.0 / kRate;
        std::complex<double> sum = 0.0;
        double given = 0.0;
        for (int i = 0; i < 2000 && given < 1.0; ++i) {
            const double share = pulse_share(((i + 0.5) / kRate - begin) / duration);
            sum += (share - given) * std::polar(1.0, -w * i / kRate);
            given = share;
        }
        const std::complex<double> exact =
            pulse_spectrum(w * duration) * std::polar(1.0, -w * (begin + 0.5 * duration));
        worst = std::max(worst, std::abs(sum * half / std::sin(half) - exact));
    }
    return 20 * std::log10(worst);
}

// Short pulses hold more above half the rate than the sample's window keeps off.
TEST(Strike, ImagesOfShortPulsesAreBounded) {
    for (const double duration : {10e-6, 20e-6, 40e-6, 100e-6, 300e-6}) {
        std::printf("pulse of %3.0f us, images:", 1e6 * duration);
        for (const double f : {1e3, 5e3, 10e3, 20e3})
            std::printf(" %.0f dB", image(duration, f));
        std::printf(" at 1, 5, 10, 20 kHz\n");
    }
    EXPECT_LT(image(10e-6, 1e3), -25);
    EXPECT_LT(image(100e-6, 5e3), -40);
    EXPECT_LT(image(300e-6, 10e3), -60);
}

TEST(Strike, FindsTheCurvatureOfABall) {
    const StruckSurface surface = ball(0.05, 3);
    for (const Vec3& way : {Vec3(1, 0.3, 0.2), Vec3(-0.2, 0.7, -0.7), Vec3(0, 0, 1)}) {
        const auto place = surface.nearest(0.06 * way.normalized(), way);
        EXPECT_NEAR(surface.curvature(place) * 0.05, 1, 0.03);
        EXPECT_NEAR(place.point.norm(), 0.05, 0.001);
    }
}

TEST(Strike, PushesByTheShapeWhereItIsStruckAndFeelsTheSame) {
    const StruckSurface surface = ball(0.05, 2);
    const Vec3 way = Vec3(1, 2, -0.5).normalized(), impulse(0.1, -0.2, 0.3);
    const auto place = surface.nearest(0.05 * way, way);
    float push[1] = {0.0f};
    surface.project(place, impulse, push);
    EXPECT_NEAR(static_cast<double>(push[0]), place.point.dot(impulse), 1e-8);
    const float rate[1] = {2.0f};
    EXPECT_LT((surface.motion(place, rate) - 2 * place.point).norm(), 1e-8);
}

// A force that is only known by its line has come in where the line enters the body.
TEST(Strike, FollowsALineOfForceToTheSurface) {
    const StruckSurface surface = ball(0.05, 3);
    const Vec3 force(0, 0, 2), arm(0.02, 0.01, 0); // upwards: from below
    const auto place = surface.entered(arm, force);
    EXPECT_NEAR(place.point.x(), 0.02, 1e-4);
    EXPECT_NEAR(place.point.y(), 0.01, 1e-4);
    EXPECT_NEAR(place.point.z(), -std::sqrt(0.05 * 0.05 - 5e-4), 1e-3);
}

} // namespace
} // namespace ode::sound
