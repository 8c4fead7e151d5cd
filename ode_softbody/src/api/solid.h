#pragma once

#include "model/solid.h"

#include <ode_softbody/softbody.h>

namespace ode::soft {

Solid from_c(const dSoftSolid& c) noexcept;

} // namespace ode::soft
