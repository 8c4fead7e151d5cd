#include "model/damping.h"

#include "base/error.h"

#include <algorithm>

namespace ode::soft {

RayleighDamping rayleigh_through(double f1, double t60_1, double f2, double t60_2) {
    for (const double v : {f1, t60_1, f2, t60_2})
        if (!(v > 0) || !std::isfinite(v))
            throw InputError(format("Rayleigh damping through T60 %g s at %g Hz and %g s at %g Hz: "
                                    "all four must be positive",
                                    t60_1, f1, t60_2, f2));
    const double w1 = 4 * std::numbers::pi * std::numbers::pi * f1 * f1;
    const double w2 = 4 * std::numbers::pi * std::numbers::pi * f2 * f2;
    const double d1 = 2 * decay_of_t60(t60_1), d2 = 2 * decay_of_t60(t60_2);
    const RayleighDamping out{(d1 * w2 - d2 * w1) / (w2 - w1), (d2 - d1) / (w2 - w1)};
    if (!(out.alpha >= 0) || !(out.beta >= 0) || !std::isfinite(out.alpha))
        throw InputError(format("no Rayleigh damping has T60 %g s at %g Hz and %g s at %g Hz: T60 "
                                "must not grow with frequency, nor fall faster than its square; "
                                "use a table",
                                t60_1, f1, t60_2, f2));
    return out;
}

DampingTable::DampingTable(std::span<const double> frequency, std::span<const double> t60)
    : frequency_(frequency.begin(), frequency.end()) {
    for (std::size_t i = 0; i < frequency.size(); ++i) {
        if (!(frequency[i] > 0 && std::isfinite(frequency[i]) && t60[i] > 0 &&
              std::isfinite(t60[i])))
            throw InputError(
                format("entry %zu of the damping table is T60 %g s at %g Hz: both must "
                       "be positive and finite",
                       i, t60[i], frequency[i]));
        if (i > 0 && !(frequency[i] > frequency[i - 1]))
            throw InputError(format("entry %zu of the damping table, %g Hz, doesn't lie above the "
                                    "one before, %g Hz: sort them by frequency",
                                    i, frequency[i], frequency[i - 1]));
        decay_.push_back(decay_of_t60(t60[i]));
    }
}

double DampingTable::decay(double f) const noexcept {
    const auto above = std::upper_bound(frequency_.begin(), frequency_.end(), f);
    if (above == frequency_.begin())
        return decay_.front();
    if (above == frequency_.end())
        return decay_.back();
    const auto i = static_cast<std::size_t>(above - frequency_.begin());
    const double share =
        std::log(f / frequency_[i - 1]) / std::log(frequency_[i] / frequency_[i - 1]);
    return decay_[i - 1] * std::pow(decay_[i] / decay_[i - 1], share);
}

} // namespace ode::soft
