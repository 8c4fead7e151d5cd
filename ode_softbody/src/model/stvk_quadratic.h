#pragma once

#include "model/stvk.h"
#include "model/tet10_packs.h"
#include "model/tet_model.h"

namespace ode::soft {

/// St. Venant-Kirchhoff on quadratic tetrahedra, four Gauss points, curved edges kept: partials
/// within a few percent where linear elements are octaves off. Mass lumped after Hinton, Rock &
/// Zienkiewicz.
using StvkQuadratic = TetModel<StvkLaw, Tet10Packs>;
extern template class TetModel<StvkLaw, Tet10Packs>;

} // namespace ode::soft
