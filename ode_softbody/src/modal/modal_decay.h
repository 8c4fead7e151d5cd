#pragma once

#include "modal/modal_model.h"

#include <span>
#include <vector>

namespace ode::soft {

/// Decay rate of each mode [1/s], exp(-d t), from what the solids dissipate:
///
///   d = (alpha + beta w^2 + eta w) / 2,
///
/// where alpha is weighted by the groups' share of the kinetic energy (of what it doesn't spare as
/// rigid motion, see damp_deformation), beta (with phi and psi, by volume change and shear) and the
/// loss factor eta by their share of the strain energy (Ungar & Kerwin, J. Acoust. Soc. Am. 34,
/// 1962): right to the second order in damping. Shares are those of the shapes on the mesh's own
/// elements; they matter only where groups differ or phi/lambda is not psi/mu.
/// @param mesh    of the order of which the shapes are
/// @param solids  by the mesh's group index
std::vector<double> modal_decays(const TetMesh& mesh, std::span<const Solid> solids,
                                 const ModalModel& modes);

} // namespace ode::soft
