#pragma once

namespace ode::soft {

/// What counts as rest: what is cut off is below -90 dB of 20 Pa at a metre, see tests/README.md.
struct RestLimits {
    double speed = 1e-3;       ///< of any node [m/s]
    double acceleration = 0.1; ///< of any node [m/s^2]; of an implicit method nothing is known
    double time = 0.25;        ///< [s]
};

} // namespace ode::soft
