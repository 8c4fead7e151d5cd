#pragma once

#include <cmath>

namespace ode::soft {

// Free flight is foreseen for so long: what turns meanwhile is taken for what doesn't.
constexpr double kLeap = 0.01; ///< [s]

/// Until what comes nearer at `closing` [m/s], or parts, may have crossed a gap [m], with so much
/// acceleration at most [s].
inline double time_to_fall(double gap, double closing, double acceleration) noexcept {
    if (!(gap > 0))
        return 0;
    return 2 * gap / (closing + std::sqrt(closing * closing + 2 * acceleration * gap));
}

} // namespace ode::soft
