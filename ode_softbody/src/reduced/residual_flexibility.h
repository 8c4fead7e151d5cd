#pragma once

#include "mesh/tet_mesh.h"
#include "modal/modal_problem.h"
#include "reduced/modal_basis.h"

namespace ode::soft {

/// What each pushed node yields to a unit force along its normal, beyond rigid motion and the given
/// modes: n^T (K + s M)^-1 n less their share, with a small shift s under which all that is left
/// answers as if it stood still [m/N]. One entry a mesh node, 0 for those not pushed.
///
/// Takes a factorisation and one solution a node.
/// @param modes  of the same mesh, order and supports, up to well below what `options` would leave
///               out.
std::vector<double> residual_flexibility(const TetMesh& mesh, std::span<const Solid> solids,
                                         const ModalOptions& options, const ModalModel& modes,
                                         const PushedNodes& pushed);

} // namespace ode::soft
