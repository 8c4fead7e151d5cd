#pragma once

#include "model/solid.h"

namespace ode::soft {

/// Refuses constants that no stable solid has: E > 0, -1 < nu < 0.5, rho > 0, damping >= 0, all
/// finite.
/// @throws InputError
void check_solid(const Solid& solid);

} // namespace ode::soft
