#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace ode::sound {

constexpr std::size_t kPredictionOrder = 32; ///< up to 16 partials

/// x[n] = sum of a[k] x[n-1-k]
using Predictor = std::array<double, kPredictionOrder>;

/// The linear prediction of least squares and least norm. It is exact for a sum of damped sines,
/// which is how a struck body rings, and its superfluous poles are damped: R. Kumaresan, D. W.
/// Tufts, IEEE Trans. Acoust. Speech Signal Process. 30(6), 833-840 (1982). Burg's recursion,
/// stable by construction, is biased and grows linearly where poles nearly coincide on the unit
/// circle. Not bounded for signals that rise. No allocation.
Predictor fit_predictor(std::span<const float> signal) noexcept;

} // namespace ode::sound
