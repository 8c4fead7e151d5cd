#pragma once

#include "model/solid.h"

#include <ode_softbody/softbody.h>

namespace ode::soft {

/// @throws InputError when struct_size is unset.
Solid from_c(const dSoftSolid& given);

} // namespace ode::soft
