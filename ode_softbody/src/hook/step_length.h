#pragma once

#include <cstddef>
#include <optional>

namespace ode::soft {

/// Where the length of the step [s] lies in the context that ODE hands to its threading
/// implementation [bytes]. No header tells, so it is measured: a world without bodies is stepped by
/// lengths that occur nowhere else, by both step functions, and exactly one place must hold them
/// all. Measured once a process, since all worlds of it run the same code.
/// @return nothing when there is no such place, or more than one: this ODE keeps it elsewhere.
std::optional<std::size_t> step_length_offset();

/// The length of a step under way [s]. @param context  as for StepListener. @param offset  as
/// above.
double read_step_length(const void* context, std::size_t offset) noexcept;

} // namespace ode::soft
