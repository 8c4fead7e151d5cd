#pragma once

#include <iosfwd>

namespace ode::soft {

/// Prints, as Markdown, every group of rows: what is measured, its error, its mark, and CPU time.
void print_coupling_table(std::ostream& out);

/// Jointed bodies against ODE stepped wholly at the substep: impulse, peak force, energy, path.
void print_island_rows(std::ostream& out);
/// Rigid bodies at rest on one another on a soft plate: mean load and ripple.
void print_pile_rows(std::ostream& out);

/// Soft bodies on soft ones by each method: energy, momenta, cost; filters of tetrahedra.
void print_soft_pair_rows(std::ostream& out, bool brief);

} // namespace ode::soft
