#pragma once

#include "model/solid.h"

#include <string>

namespace ode::soft {

/// Refuses constants that no stable solid has: E > 0, -1 < nu < 0.5, rho > 0, damping >= 0, all
/// finite.
/// @param group  name of the elements made of it; empty: the whole body.
/// @throws InputError
void check_solid(const Solid& solid, const std::string& group = {});

} // namespace ode::soft
