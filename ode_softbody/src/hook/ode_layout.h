#pragma once

#include <cstddef>
#include <cstring>
#include <optional>

namespace ode::soft {

/// Places in ODE's own objects that no header tells [bytes]. They are measured, once a process: all
/// worlds of it run the same code.
struct OdeLayout {
    std::size_t step_length;    ///< [s], in the context of a step
    std::size_t functions;      ///< of the threading implementation, in a world
    std::size_t implementation; ///< its id, in a world
};

/// Measures in a world of our own: gives it a threading implementation and steps it, without
/// bodies, by lengths that occur nowhere else, with both step functions. Each thing must be in
/// exactly one place, always the same.
/// @return nothing when one isn't: this ODE keeps it elsewhere.
std::optional<OdeLayout> ode_layout();

/// What is at a place in a world or a context.
template <class Value>
Value value_at(const void* object, std::size_t offset) noexcept {
    Value value;
    std::memcpy(&value, static_cast<const char*>(object) + offset, sizeof value);
    return value;
}

} // namespace ode::soft
