#include "dsp/splat_table.h"

#include "dsp/kaiser.h"

#include <cmath>
#include <numbers>

namespace ode::sound {

namespace {

/// The taps for a fraction of a sample.
void fill_row(double fraction, double* row) {
    constexpr int kTaps = SplatTable::kTaps;
    constexpr double kAttenuation = 140.0; // what 16 taps and a transition of 0.583 allow
    static const double beta = kaiser_beta(kAttenuation);
    double sum = 0.0;
    for (int j = 0; j < kTaps; ++j) {
        const double x = j - SplatTable::kBefore - fraction;
        row[j] = sinc(x) * kaiser(x / (0.5 * kTaps), beta);
        sum += row[j];
    }
    for (int j = 0; j < kTaps; ++j)
        row[j] /= sum;
}

} // namespace

SplatTable::SplatTable()
    : moment_(static_cast<std::size_t>(kMoments) * kTaps),
      row_(static_cast<std::size_t>(kPhases + 1) * kTaps) {
    for (int p = 0; p <= kPhases; ++p)
        fill_row(static_cast<double>(p) / kPhases,
                 row_.data() + static_cast<std::size_t>(p) * kTaps);
    // Lagrange's polynomials through Chebyshev's points, multiplied out.
    double point[kMoments], row[kTaps];
    for (int i = 0; i < kMoments; ++i)
        point[i] = 0.5 * std::cos(std::numbers::pi * (i + 0.5) / kMoments);
    for (int i = 0; i < kMoments; ++i) {
        fill_row(0.5 + point[i], row);
        double basis[kMoments] = {1.0};
        for (int k = 0, degree = 0; k < kMoments; ++k) {
            if (k == i)
                continue;
            ++degree;
            for (int m = degree; m >= 0; --m)
                basis[m] =
                    ((m > 0 ? basis[m - 1] : 0.0) - point[k] * basis[m]) / (point[i] - point[k]);
        }
        for (int m = 0; m < kMoments; ++m)
            for (int j = 0; j < kTaps; ++j)
                moment_[static_cast<std::size_t>(m * kTaps + j)] += basis[m] * row[j];
    }
    float_row_.assign(row_.begin(), row_.end());
}

const SplatTable& splat_table() {
    static const SplatTable table;
    return table;
}

} // namespace ode::sound
