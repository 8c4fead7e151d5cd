#pragma once

#include "model/solid.h"

#include <span>
#include <string_view>

namespace ode::soft {

/// A named material with published constants.
struct Material {
    const char* name;
    Solid solid;
    const char* source; ///< of the constants and of the damping
};

/// All presets, in a fixed order.
std::span<const Material> materials() noexcept;

/// nullptr for an unknown name.
const Material* find_material(std::string_view name) noexcept;

} // namespace ode::soft
