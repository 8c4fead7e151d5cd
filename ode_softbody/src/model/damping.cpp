#include "model/damping.h"

#include "base/error.h"

#include <algorithm>

namespace ode::soft {
namespace {

void require_not_negative(double value, const char* what) {
    if (!(value >= 0) || !std::isfinite(value))
        throw InputError(format("%s is %g: it must be zero or positive", what, value));
}

} // namespace

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

std::vector<double> Damping::decays(std::span<const double> frequency) const {
    std::vector<double> out;
    out.reserve(frequency.size());
    switch (law) {
    case Law::kRayleigh:
        require_not_negative(rayleigh.alpha, "mass-proportional damping alpha [1/s]");
        require_not_negative(rayleigh.beta, "stiffness-proportional damping beta [s]");
        for (const double f : frequency)
            out.push_back(rayleigh.decay(f));
        break;
    case Law::kLossFactor:
        require_not_negative(loss_factor, "the loss factor");
        for (const double f : frequency)
            out.push_back(decay_of_loss_factor(loss_factor, f));
        break;
    case Law::kTable:
        if (t60.empty())
            throw InputError("the table of decay times is empty: give T60 in seconds for one mode "
                             "at least");
        for (std::size_t i = 0; i < t60.size(); ++i)
            if (!(t60[i] > 0))
                throw InputError(format("T60 of mode %zu is %g s: it must be positive", i, t60[i]));
        for (std::size_t i = 0; i < frequency.size(); ++i)
            out.push_back(decay_of_t60(t60[std::min(i, t60.size() - 1)]));
        break;
    }
    return out;
}

} // namespace ode::soft
