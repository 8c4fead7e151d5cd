#pragma once

#include <ode/common.h>

namespace ode::soft {

/// Whether calls of dWorldStep and dWorldQuickStep for this world reach this library before ODE: it
/// was linked ahead of ODE, or preloaded. A library loaded late may come first in the dynamic
/// linker's order and still be passed by, because callers were bound before; but then it did not
/// see the world being made either.
bool steps_are_interposed(dWorldID world);

} // namespace ode::soft
