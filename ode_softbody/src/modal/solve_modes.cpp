#include "modal/solve_modes.h"

#include "base/error.h"
#include "modal/modal_problem.h"
#include "modal/pitch.h"

namespace ode::soft {

ModalModel solve_modes(const TetMesh& mesh, std::span<const Solid> solids,
                       const ModalOptions& options) {
    if (options.order > 3) // the quartic order only judges
        throw InputError(
            format("element order %d is not available: take 1, 2 or 3", options.order));
    if (options.estimate)
        return solve_with_band(mesh, solids, options);
    ModalProblem problem(mesh, solids, options);
    const EigenPairs pairs = problem.solve();
    return problem.model(pairs);
}

} // namespace ode::soft
