#pragma once

#include "bench/time/error_vs_time.h"

namespace ode::soft {

/// Error over run time as a PNG, a panel a scene, the front as a line.
/// @return "" when all went well, else a sentence the user can act on.
std::string plot_front(const std::vector<TimeRow>& rows, const std::string& path);

} // namespace ode::soft
