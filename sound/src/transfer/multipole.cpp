#include "transfer/multipole.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {

// Recurrences of normalised Legendre functions (Numerical Recipes, 3rd ed., 6.7). sin^m goes with
// cos(m phi) and sin(m phi) as powers of x + iy, so that the poles need no care.
void harmonics(const Eigen::Vector3d& direction, int order, double* out) noexcept {
    const double c = direction[2];
    double real = 1.0, imag = 0.0; // (x + iy)^m
    double first = 0.5 / std::sqrt(std::numbers::pi);
    for (int m = 0; m <= order; ++m) {
        if (m > 0) {
            const double next = real * direction[0] - imag * direction[1];
            imag = real * direction[1] + imag * direction[0];
            real = next;
            first *= std::sqrt((2.0 * m + 1.0) / (2.0 * m));
        }
        const double scale = m > 0 ? std::numbers::sqrt2 : 1.0;
        double before = 0.0;
        double now = first;
        for (int l = m; l <= order; ++l) {
            if (l > m) {
                const double l2 = static_cast<double>(l) * l, m2 = static_cast<double>(m) * m;
                const double k2 = (l - 1.0) * (l - 1.0);
                const double up = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
                const double down = l - 1 > m ? std::sqrt((k2 - m2) / (4.0 * k2 - 1.0)) : 0.0;
                const double next = up * (c * now - down * before);
                before = now;
                now = next;
            }
            out[l * l + l + m] = scale * now * real;
            if (m > 0)
                out[l * l + l - m] = scale * now * imag;
        }
    }
}

void spherical_bessel(double x, int order, double* out) noexcept {
    if (x < 1e-8) {
        std::fill_n(out, order + 1, 0.0);
        out[0] = 1.0;
        if (order > 0)
            out[1] = x / 3.0;
        return;
    }
    // Miller's algorithm: downward from far above, then scaled to the larger of j_0 and j_1.
    const int start = order + 20 + static_cast<int>(std::ceil(x + 4.0 * std::cbrt(x)));
    double above = 0.0, now = 1e-280;
    for (int l = start; l > 0; --l) {
        const double below = (2.0 * l + 1.0) / x * now - above;
        above = now;
        now = below;
        if (std::abs(now) > 1e200) {
            constexpr double kShrink = 1e-200;
            now *= kShrink;
            above *= kShrink;
            for (int i = l; i <= order; ++i)
                out[i] *= kShrink;
        }
        if (l - 1 <= order)
            out[l - 1] = now;
    }
    const double j0 = std::sin(x) / x;
    const double j1 = (j0 - std::cos(x)) / x;
    const double scale = std::abs(j0) > std::abs(j1) ? j0 / now : j1 / above;
    for (int l = 0; l <= order; ++l)
        out[l] *= scale;
}

void spherical_hankel(double x, int order, std::complex<double>* out) noexcept {
    const std::complex<double> wave = std::polar(1.0, -x);
    const std::complex<double> i(0.0, 1.0);
    out[0] = i * wave / x;
    if (order > 0)
        out[1] = wave * (i / x - 1.0) / x;
    for (int l = 1; l < order; ++l)
        out[l + 1] = (2.0 * l + 1.0) / x * out[l] - out[l - 1];
}

} // namespace ode::sound
