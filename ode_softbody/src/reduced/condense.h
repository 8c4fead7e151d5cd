#pragma once

#include "modal/modal_problem.h"
#include "modal/solve_modes.h"
#include "reduced/cubic_terms.h"
#include "reduced/modal_basis.h"

namespace ode::soft {

/// How much of a body is kept non-linear.
struct CubicExtent {
    std::size_t kept = 20;      ///< of the modes, the first ones; no more than there are
    std::size_t driven = 0;     ///< of those that follow; no more than are heard
    std::size_t following = 32; ///< shapes of what answers at once
};

/// The cubic tier's coefficients of a St. Venant-Kirchhoff solid. What is neither kept nor driven
/// is solved for: what each pair's load moves, by a factor of the stiffness matrix, is subtracted
/// from the quartic energy as the work that it gives way by.
///
/// Takes a factorisation and kept^2 / 2 solutions.
/// @param modes    of the same mesh, order and supports.
/// @param options  that they were found with.
/// @param mass     lumped, of each node [kg].
CubicTerms::Coefficients condense(const TetMesh& mesh, std::span<const Solid> solids,
                                  const ModalOptions& options, const ModalModel& modes,
                                  std::span<const double> mass, const CubicExtent& extent);

} // namespace ode::soft
