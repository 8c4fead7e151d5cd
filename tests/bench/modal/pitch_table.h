#pragma once

#include <iosfwd>

namespace ode::soft {

/// Prints, as a Markdown table, every pitch case by element order and mesh: nodes, seconds of CPU
/// time, and the error of the first eight partials in cents against a converged reference, matched
/// by shape, with the band that the library itself claims.
void print_pitch_table(std::ostream& out);

} // namespace ode::soft
