#include "modal/solve_modes.h"

#include "modal/modal_problem.h"
#include "modal/pitch.h"

namespace ode::soft {

ModalModel solve_modes(const TetMesh& mesh, std::span<const Solid> solids,
                       const ModalOptions& options) {
    if (options.estimate)
        return solve_with_band(mesh, solids, options);
    ModalProblem problem(mesh, solids, options);
    const EigenPairs pairs = problem.solve();
    return problem.model(pairs);
}

} // namespace ode::soft
