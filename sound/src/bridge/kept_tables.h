#pragma once

#include "transfer/table_cache.h"

namespace ode::sound {

/// Tables are kept where the modes are, and what is wrong with them is told through ODE.
TableCache kept_tables();

} // namespace ode::sound
