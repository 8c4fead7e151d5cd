#pragma once

#include "modal/modal_problem.h"

namespace ode::soft {

/// solve_modes() with an estimate.
ModalModel solve_with_band(const TetMesh& mesh, std::span<const Solid> solids,
                           const ModalOptions& options);

} // namespace ode::soft
