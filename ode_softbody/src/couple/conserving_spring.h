#pragma once

#include <cmath>

namespace ode::soft {

/// Force of a one-sided spring, V(d) = k max(0, d)^2 / 2 for depth d, that keeps energy exactly
/// under leapfrog, for any stiffness.
///
/// An explicit force k d starts at whatever depth the first substep inside finds and so gives or
/// takes up to k (v dt)^2 / 2 at each touch. The discrete gradient between the depths a, one
/// substep ago, and b, one substep ahead,
///     F = (V(b) - V(a)) / (b - a),   b = b0 - g F,
/// changes (v_+^2 - v_-^2) / 2 by exactly (V(a) - V(b)) / 2 (S. Bilbao, A. Torin, V. Chatziioannou,
/// Acta Acustica 101 (2015), doi:10.3813/AAA.918813). V is quadratic on each side, so b is the root of
/// a quadratic and needs no iteration.
/// @param k   [N/m], >= 0
/// @param g   dt^2 times the inverse effective mass of the two sides [s^2/kg], > 0
/// @param a   depth a substep ago [m]
/// @param b0  depth a substep ahead if the spring weren't there [m]
/// @return [N], >= 0
inline double conserving_press(double k, double g, double a, double b0) noexcept {
    if (a <= 0 && b0 <= 0)
        return 0;
    const double kappa = k * g;
    if (a <= 0) { // enters: (1 + kappa/2) b^2 - (a + b0) b + a b0 = 0
        const double sum = a + b0;
        const double lead = 2 + kappa;
        const double b = (sum + std::sqrt(sum * sum - 2 * lead * a * b0)) / lead;
        return k * b * b / (2 * (b - a));
    }
    const double b = (b0 - kappa * a / 2) / (1 + kappa / 2);
    if (b > 0)
        return k * (a + b) / 2;
    // Leaves: (b - b0) (b - a) = kappa a^2 / 2, the root below zero.
    const double half = (a - b0) / 2;
    const double out = (a + b0) / 2 - std::sqrt(half * half + kappa * a * a / 2);
    return k * a * a / (2 * (a - out));
}

} // namespace ode::soft
