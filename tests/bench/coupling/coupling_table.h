#pragma once

#include "bench/coupling/table.h"

#include <vector>

namespace ode::soft {

/// Every group of rows: what is measured, its error, its mark, and CPU time.
/// @param brief  one or two of each kind, within seconds, for continuous integration
std::vector<Table> coupling_tables(bool brief);

/// Jointed bodies against ODE stepped wholly at the substep: impulse, peak force, energy, path.
Table island_table(bool brief);
/// Rigid bodies at rest on one another on a soft plate: mean load and ripple.
Table pile_table(bool brief);
/// Rigid bodies thrown on a free soft plate, through ODE's steps: energy and momenta.
Table soft_rigid_table(bool brief);
/// Soft bodies thrown at each other, by each method: energy, momenta, cost.
Table soft_pair_table(bool brief);
/// Filters of pairs of tetrahedra before the volume penalty: cost and what they let pass.
Table filter_table(bool brief);

} // namespace ode::soft
