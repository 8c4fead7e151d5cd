// Contact times, force pulses and struck surfaces against closed forms.
#include "strike/hertz.h"
#include "strike/pulse.h"
#include "strike/sampled_pulse.h"
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

/// Of a row of samples at w [rad a sample].
std::complex<double> heard(const SampledPulse& pulse, double w) {
    std::complex<double> sum = 0;
    float one = 0.0f;
    for (std::int64_t i = pulse.first(); i < pulse.end(); ++i) {
        pulse.read(i, 1, &one);
        sum += static_cast<double>(one) * std::polar(1.0, -w * static_cast<double>(i));
    }
    return sum;
}

// Samples hold what the pulse holds, smoothed or made flat again, wherever in a sample it begins.
TEST(Strike, SamplesOfAPulseHoldItsSpectrum) {
    using Window = SampledPulse::Window;
    for (const double duration : {1.0, 5.0, 15.0, 16.5, 40.0})
        for (const double begin : {100.0, 100.3, 100.77})
            for (const Window window : {Window::kSmooth, Window::kFlat}) {
                SampledPulse pulse;
                pulse.aim(begin, duration, window);
                EXPECT_NEAR(std::abs(heard(pulse, 0)), 1, 1e-3);
                EXPECT_EQ(pulse.rest(0), 1);
                EXPECT_EQ(pulse.rest(pulse.end()), 0);
                for (const double f : {1.0 / 48, 4.0 / 48, 8.0 / 48}) {
                    const double w = 2 * std::numbers::pi * f, half = 0.5 * w;
                    // Of a flat one as it is heard, held for a sample.
                    const double held = window == Window::kFlat ? std::sin(half) / half : 1.0;
                    const double kept = !pulse.is_short() || window == Window::kFlat
                                            ? 1.0
                                            : SampledPulse::smoothing(w);
                    const std::complex<double> exact =
                        kept * pulse_spectrum(w * duration).value *
                        std::polar(1.0, -w * (begin + 0.5 * duration));
                    const double short_of = pulse.is_short() ? held : 1.0;
                    // 0.14 dB, and images: by sinc(40/48 pi)^3 at 8 kHz of 48.
                    EXPECT_NEAR(std::abs(heard(pulse, w) * short_of - exact), 0, 0.02)
                        << duration << ' ' << begin << ' ' << f;
                }
            }
}

TEST(Strike, WhatIsLateComesAtOnce) {
    using Window = SampledPulse::Window;
    for (const double duration : {3.0, 12.0, 30.0, 100.0})
        for (const std::int64_t earliest : {8, 11, 20, 31, 200}) {
            SampledPulse pulse, whole;
            whole.aim(10.2, duration, Window::kSmooth);
            pulse.aim(10.2, duration, Window::kSmooth);
            pulse.hurry(earliest);
            EXPECT_GE(pulse.first(), earliest > 9 ? earliest : 9);
            double sum = 0.0;
            for (std::int64_t i = 0; i < 250; ++i) {
                float one = 0.0f, same = 0.0f;
                pulse.read(i, 1, &one);
                whole.read(i, 1, &same);
                sum += static_cast<double>(one);
                if (i < earliest) {
                    EXPECT_EQ(one, 0.0f);
                } else if (i > earliest) {
                    EXPECT_EQ(one, same) << i << ' ' << duration;
                }
            }
            EXPECT_NEAR(sum, 1, 2e-3) << duration << ' ' << earliest;
        }
}

TEST(Strike, IsFeltAsItsSpectrumSays) {
    EXPECT_NEAR(pulse_spectrum(0).value, 1, 1e-9);
    for (const double x : {1.0, 5.0, 12.1, 20.0}) {
        std::complex<double> sum = 0;
        for (int i = 0; i < 10000; ++i) {
            const double u = (i + 0.5) / 10000;
            sum += (pulse_share(u + 5e-5) - pulse_share(u - 5e-5)) * std::polar(1.0, x * (u - 0.5));
        }
        EXPECT_NEAR(pulse_spectrum(x).value, sum.real(), 2e-5) << x; // of 256 cells
        EXPECT_NEAR(sum.imag(), 0, 1e-9);
        const double apart = pulse_spectrum(x + 1e-4).value - pulse_spectrum(x - 1e-4).value;
        EXPECT_NEAR(pulse_spectrum(x).slope, apart / 2e-4, 2e-5) << x;
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
