#pragma once

#include <cmath>
#include <numbers>

namespace ode::sound {

/// Cosine and sine of n angles, without a branch, so that compilers do several at once. Taylor's
/// series on [-pi, pi]: 6e-10 off at most.
inline void turn(const double* angle, int n, double* cosine, double* sine) noexcept {
    constexpr double kRound = 6755399441055744.0; // 1.5 * 2^52: adding it drops the fraction
    constexpr double kTurn = 2.0 * std::numbers::pi;
    for (int i = 0; i < n; ++i) {
        const double turns = (angle[i] * (1.0 / kTurn) + kRound) - kRound;
        const double x = angle[i] - turns * kTurn;
        const double s = x * x;
        double c = 1.0 / 2432902008176640000.0;
        c = c * s - 1.0 / 6402373705728000.0;
        c = c * s + 1.0 / 20922789888000.0;
        c = c * s - 1.0 / 87178291200.0;
        c = c * s + 1.0 / 479001600.0;
        c = c * s - 1.0 / 3628800.0;
        c = c * s + 1.0 / 40320.0;
        c = c * s - 1.0 / 720.0;
        c = c * s + 1.0 / 24.0;
        c = c * s - 0.5;
        cosine[i] = c * s + 1.0;
        double q = -1.0 / 121645100408832000.0;
        q = q * s + 1.0 / 355687428096000.0;
        q = q * s - 1.0 / 1307674368000.0;
        q = q * s + 1.0 / 6227020800.0;
        q = q * s - 1.0 / 39916800.0;
        q = q * s + 1.0 / 362880.0;
        q = q * s - 1.0 / 5040.0;
        q = q * s + 1.0 / 120.0;
        q = q * s - 1.0 / 6.0;
        sine[i] = x + x * (q * s);
    }
}

} // namespace ode::sound
