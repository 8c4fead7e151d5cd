#pragma once

#include "model/stvk.h"
#include "model/tet4_packs.h"
#include "model/tet_model.h"

namespace ode::soft {

/// The source paper's solid: linear tetrahedra, St. Venant-Kirchhoff with viscosity, lumped mass
/// (P01 3.1). Locks in bending: see StvkQuadratic for pitch.
using StvkLinear = TetModel<StvkLaw, Tet4Packs>;
extern template class TetModel<StvkLaw, Tet4Packs>;

} // namespace ode::soft
