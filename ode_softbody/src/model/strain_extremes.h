#pragma once

#include "model/elastic_model.h"
#include "model/tet_kernel.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace ode::soft {

inline constexpr DeformationRange kNoDeformation{std::numeric_limits<double>::infinity(), 0, 0};

/// Of both lists of elements. What isn't finite in one isn't in the sum either.
inline DeformationRange widened(const DeformationRange& a, const DeformationRange& b) noexcept {
    const double energy = a.energy + b.energy;
    return {std::fmin(a.min_determinant, b.min_determinant) + 0 * energy,
            std::fmax(a.max_trace, b.max_trace), energy};
}

/// The largest principal stretch l of an element obeys l^2 + 2 J/l <= tr(F^T F), because the other
/// two squares sum to at least twice their product. So the largest root of l^3 - t l + 2 J = 0
/// bounds it, with equality at rest; least J with greatest t bounds all elements at once.
inline StrainExtremes strain_extremes(const DeformationRange& range) noexcept {
    const double t = range.max_trace;
    const double j = std::fmax(range.min_determinant, 0); // inverted elements: l <= sqrt(t)
    const double cosine = std::fmax(-1.0, -j * std::pow(3 / t, 1.5));
    const double stretch = 2 * std::sqrt(t / 3) * std::cos(std::acos(cosine) / 3);
    return {range.min_determinant, stretch, range.energy};
}

} // namespace ode::soft
