#include "couple/conserving_spring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

double potential(double k, double d) {
    return k * std::max(0.0, d) * std::max(0.0, d) / 2;
}

// The relation that defines the force, whatever branch it came from.
TEST(ConservingSpring, IsTheDiscreteGradientAtTheDepthItLeadsTo) {
    for (const double k : {1.0, 1e3})
        for (const double g : {1e-6, 1e-3, 1.0})
            for (const double a : {-1.0, -1e-3, 0.0, 1e-3, 1.0})
                for (const double b0 : {-1.0, -1e-3, 0.0, 1e-3, 1.0}) {
                    const double f = conserving_press(k, g, a, b0);
                    const double b = b0 - g * f;
                    EXPECT_GE(f, 0);
                    const double change = potential(k, b) - potential(k, a);
                    const double scale = potential(k, b) + potential(k, a) + f * std::abs(b - a);
                    // b is found by cancellation between b0 and g f, k g times as large.
                    EXPECT_NEAR(f * (b - a), change, 1e-13 * (1 + k * g) * scale + 1e-300)
                        << k << ' ' << g << ' ' << a << ' ' << b0;
                }
}

// A mass between two walls, far beyond the explicit limit k dt^2 / m = 4.
TEST(ConservingSpring, KeepsEnergyOverAMillionStepsAtAnyStiffness) {
    constexpr double m = 2, dt = 1e-3, width = 0.1;
    for (const double kappa : {0.1, 1.0, 10.0, 1000.0}) {
        const double k = kappa * m / (dt * dt);
        const double g = dt * dt / m;
        double before = 0.03, x = before + dt * 1.234, v = 1.234;
        const double start = m * v * v / 2;
        double worst = 0;
        for (int i = 0; i < 1'000'000; ++i) {
            const double free = x + dt * v;
            const double f = conserving_press(k, g, -before, -free) -
                             conserving_press(k, g, before - width, free - width);
            v += dt * f / m;
            before = x;
            x += dt * v;
            const auto wall = [&](double at) {
                return potential(k, -at) + potential(k, at - width);
            };
            worst = std::max(worst, std::abs(m * v * v / 2 + (wall(x) + wall(before)) / 2 - start));
        }
        EXPECT_LT(worst, 1e-9 * start) << kappa; // rounding of 1e6 steps
    }
}

} // namespace
} // namespace ode::soft
