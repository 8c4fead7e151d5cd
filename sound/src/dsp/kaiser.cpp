#include "dsp/kaiser.h"

#include <cmath>
#include <numbers>

namespace ode::sound {

double bessel_i0(double x) noexcept {
    // Power series; all terms are positive, so it is exact to rounding for the x < 20 used here.
    const double q = 0.25 * x * x;
    double term = 1.0;
    double sum = 1.0;
    for (int k = 1; term > 1e-17 * sum; ++k) {
        term *= q / (static_cast<double>(k) * k);
        sum += term;
    }
    return sum;
}

double kaiser(double u, double beta) noexcept {
    const double inside = 1.0 - u * u;
    return inside < 0.0 ? 0.0 : bessel_i0(beta * std::sqrt(inside)) / bessel_i0(beta);
}

double kaiser_beta(double attenuation) noexcept { return 0.1102 * (attenuation - 8.7); }

int kaiser_length(double attenuation, double transition) noexcept {
    return 1 + static_cast<int>(
                   std::ceil((attenuation - 7.95) / (2.285 * 2.0 * std::numbers::pi * transition)));
}

double sinc(double x) noexcept {
    const double a = std::numbers::pi * x;
    return std::abs(a) < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a;
}

double sinc_slope(double x) noexcept {
    const double a = std::numbers::pi * x;
    return std::abs(a) < 1e-4 ? -std::numbers::pi * a / 3.0
                              : std::numbers::pi * (std::cos(a) - std::sin(a) / a) / a;
}

} // namespace ode::sound
