#pragma once

#include "mesh/tet_mesh.h"
#include "modal/modal_problem.h"
#include "reduced/modal_basis.h"

namespace ode::soft {

/// What each pushed node yields to a unit force along a direction n, beyond rigid motion and some
/// of the given modes: n^T (K + s M)^-1 n less their share, with a small shift s under which all
/// that is left answers as if it stood still. Along its normal, and along the surface.
///
/// Takes a factorisation and two solutions a node.
/// @param modes  of the same mesh, order and supports, up to well below what `options` would leave
///               out.
/// @param kept   numbers of modes, the first ones, ascending: one result each.
std::vector<ResidualFlexibility>
residual_flexibility(const TetMesh& mesh, std::span<const Solid> solids,
                     const ModalOptions& options, const ModalModel& modes,
                     const PushedNodes& pushed, std::span<const std::size_t> kept);

} // namespace ode::soft
