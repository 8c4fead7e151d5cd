// Each method's code against its closed form in the modal domain: x'' + 2 zeta w x' + w^2 x = 0.
#include "integrate/modal_response.h"

#include "integrate/critical_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

namespace ode::soft {
namespace {

using Complex = std::complex<double>;

/// Stability function R(z), z = lambda h, of a method that treats position and velocity alike
/// (Hairer & Wanner 1996, IV.2-3).
struct OneStep {
    const char* name;
    std::function<Complex(Complex)> r;
};

Complex tr_bdf2(Complex z) {
    const double g = 2 - std::numbers::sqrt2, c = g / 2;
    const Complex middle = (1.0 + c * z) / (1.0 - c * z);
    return (middle - (1 - g) * (1 - g)) / (g * (2 - g)) / (1.0 - c * z);
}

const std::vector<OneStep>& one_step_methods() {
    static const std::vector<OneStep> all = {
        {"explicit-euler", [](Complex z) { return 1.0 + z; }},
        {"modified-euler", [](Complex z) { return 1.0 + z + z * z / 2.0; }},
        {"midpoint", [](Complex z) { return 1.0 + z + z * z / 2.0; }},
        {"runge-kutta-4",
         [](Complex z) { return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))); }},
        {"backward-euler", [](Complex z) { return 1.0 / (1.0 - z); }},
        {"linearised-backward-euler", [](Complex z) { return 1.0 / (1.0 - z); }},
        {"trapezoidal", [](Complex z) { return (1.0 + z / 2.0) / (1.0 - z / 2.0); }},
        {"tr-bdf2", tr_bdf2}};
    return all;
}

TEST(ModalResponse, IsTheStabilityFunctionOfOneStepMethods) {
    for (const OneStep& method : one_step_methods()) {
        ModalAnalysis analysis(method.name);
        for (const double wh : {0.01, 0.3, 1.0, 2.5, 20.0})
            for (const double zeta : {0.0, 0.01, 0.3}) {
                const Complex lambda(-zeta, std::sqrt(1 - zeta * zeta));
                const Complex z = method.r(lambda * wh);
                const ModalResponse r = analysis.response(wh, zeta);
                EXPECT_NEAR(r.amplification, std::abs(z), 1e-12 * (1 + std::abs(z)))
                    << method.name << " " << wh << " " << zeta;
                const Complex rate = std::log(z);
                EXPECT_NEAR(r.artificial_damping, -rate.real() / std::abs(rate) - zeta, 1e-9)
                    << method.name << " " << wh << " " << zeta;
                if (std::abs(z.imag()) > 1e-6) {
                    EXPECT_NEAR(r.period_error, lambda.imag() * wh / std::abs(rate.imag()) - 1,
                                1e-9)
                        << method.name << " " << wh << " " << zeta;
                }
            }
    }
}

// cos(theta) = 1 - (w h)^2 / 2, |z| = 1; with the lagged dashpot det = 1 - 2 zeta w h.
TEST(ModalResponse, OfLeapfrogIsItsClosedForm) {
    for (const char* name : {"central-difference", "symplectic-euler"}) {
        ModalAnalysis analysis(name);
        for (const double wh : {0.05, 0.5, 1.9}) {
            const ModalResponse r = analysis.response(wh, 0);
            EXPECT_NEAR(r.amplification, 1, 1e-14);
            EXPECT_NEAR(r.artificial_damping, 0, 1e-12);
            EXPECT_NEAR(r.period_error, wh / std::acos(1 - wh * wh / 2) - 1, 1e-12);
            EXPECT_NEAR(analysis.response(wh, 0.02).amplification, std::sqrt(1 - 0.04 * wh), 1e-14);
        }
        EXPECT_GT(analysis.response(2.01, 0).amplification, 1);
    }
}

// Undamped: leapfrog 2, Runge-Kutta 2 sqrt(2), the weakly unstable none, the implicit all.
TEST(ModalAnalysis, FindsCriticalSteps) {
    const auto limit = [](const char* name, double beta) {
        return ModalAnalysis(name).critical_step(5.0, beta);
    };
    for (const char* name : {"central-difference", "symplectic-euler"})
        for (const double beta : {0.0, 0.1}) {
            const double exact = critical_step(5.0, beta);
            EXPECT_LE(limit(name, beta), exact * (1 + 1e-6));
            EXPECT_GE(limit(name, beta), 0.998 * exact);
        }
    EXPECT_NEAR(limit("runge-kutta-4", 0), 2 * std::numbers::sqrt2 / 5, 1e-3);
    for (const char* name : {"explicit-euler", "modified-euler", "midpoint"})
        EXPECT_EQ(limit(name, 0), 0) << name;
    for (const char* name :
         {"backward-euler", "linearised-backward-euler", "trapezoidal", "tr-bdf2"})
        for (const double beta : {0.0, 0.1})
            EXPECT_EQ(limit(name, beta), std::numeric_limits<double>::infinity()) << name;
    // |1 + h lambda|^2 = 1 - h beta w^2 + h^2 w^2 <= 1 for h <= beta while modes swing.
    EXPECT_NEAR(limit("explicit-euler", 0.1), 0.1, 2e-4);
    // 1 - z^2 ... : (w h)^3 = 8 zeta = 4 beta w to leading order in beta.
    EXPECT_NEAR(limit("midpoint", 0.002), std::cbrt(4 * 0.002 * 5) / 5, 0.02 * 0.07);
}

} // namespace
} // namespace ode::soft
