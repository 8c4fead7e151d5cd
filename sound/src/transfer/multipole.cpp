#include "transfer/multipole.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace ode::sound {

namespace {

/// Factors of the recurrences, up to the highest degree that anybody asks for.
struct Recurrence {
    static std::size_t at(int l, int m) { return static_cast<std::size_t>(l * (l + 1) / 2 + m); }

    Recurrence() {
        double own = 0.5 / std::sqrt(std::numbers::pi);
        for (int l = 0; l <= kMaxOrder; ++l) {
            if (l > 0)
                own *= std::sqrt((2.0 * l + 1.0) / (2.0 * l));
            first[static_cast<std::size_t>(l)] = own;
            const double l2 = static_cast<double>(l) * l, k2 = (l - 1.0) * (l - 1.0);
            for (int m = 0; m < l; ++m) {
                const double m2 = static_cast<double>(m) * m;
                up[at(l, m)] = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
                down[at(l, m)] = l - 1 > m ? std::sqrt((k2 - m2) / (4.0 * k2 - 1.0)) : 0.0;
            }
        }
    }

    static constexpr std::size_t kEntries = (kMaxOrder + 1) * (kMaxOrder + 2) / 2;
    std::array<double, kMaxOrder + 1> first{};
    std::array<double, kEntries> up{}, down{};
};

} // namespace

// Recurrences of normalised Legendre functions (Numerical Recipes, 3rd ed., 6.7), all orders of a
// degree at once. sin^m goes with cos(m phi) and sin(m phi) as powers of x + iy, so that the poles
// need no care.
void harmonics(const Eigen::Vector3d& direction, int order, double* out) noexcept {
    static const Recurrence table;
    order = std::min(order, kMaxOrder);
    const double c = direction[2];
    double real[kMaxOrder + 1], imag[kMaxOrder + 1]; // (x + iy)^m, times sqrt(2) but for m = 0
    double row[3][kMaxOrder + 2] = {};
    double x = 1.0, y = 0.0;
    for (int m = 0; m <= order; ++m) {
        const double scale = m > 0 ? std::numbers::sqrt2 : 1.0;
        real[m] = scale * x;
        imag[m] = scale * y;
        const double next = x * direction[0] - y * direction[1];
        y = x * direction[1] + y * direction[0];
        x = next;
    }
    for (int l = 0; l <= order; ++l) {
        double* const now = row[l % 3];
        const double *const before = row[(l + 2) % 3], *const earlier = row[(l + 1) % 3];
        const double *const up = &table.up[Recurrence::at(l, 0)],
                            *const down = &table.down[Recurrence::at(l, 0)];
        for (int m = 0; m < l; ++m)
            now[m] = up[m] * (c * before[m] - down[m] * earlier[m]);
        now[l] = table.first[static_cast<std::size_t>(l)];
        double* const middle = out + l * l + l;
        for (int m = 0; m <= l; ++m)
            middle[m] = now[m] * real[m];
        for (int m = 1; m <= l; ++m)
            middle[-m] = now[m] * imag[m];
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
