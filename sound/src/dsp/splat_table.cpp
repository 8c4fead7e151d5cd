#include "dsp/splat_table.h"

#include "dsp/kaiser.h"

namespace ode::sound {

SplatTable::SplatTable() : row_(static_cast<std::size_t>(kPhases + 1) * kTaps) {
    constexpr double kAttenuation = 140.0; // what 16 taps and a transition of 0.583 allow
    const double beta = kaiser_beta(kAttenuation);
    for (int p = 0; p <= kPhases; ++p) {
        double* row = row_.data() + static_cast<std::size_t>(p) * kTaps;
        double sum = 0.0;
        for (int j = 0; j < kTaps; ++j) {
            const double x = j - kBefore - static_cast<double>(p) / kPhases;
            row[j] = sinc(x) * kaiser(x / (0.5 * kTaps), beta);
            sum += row[j];
        }
        for (int j = 0; j < kTaps; ++j)
            row[j] /= sum;
    }
    float_row_.assign(row_.begin(), row_.end());
}

const SplatTable& splat_table() {
    static const SplatTable table;
    return table;
}

} // namespace ode::sound
