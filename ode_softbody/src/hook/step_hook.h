#pragma once

#include <ode/common.h>

namespace ode::soft {

/// Whether calls of dWorldStep and dWorldQuickStep anywhere in the process reach this library
/// before ODE: it was linked ahead of ODE, or preloaded.
bool steps_are_interposed() noexcept;

} // namespace ode::soft
