#pragma once

#include "modal/modal_problem.h"

namespace ode::soft {

/// Modes of the next order up, from those of the order below on the same mesh.
struct Refined {
    Eigen::VectorXd value; ///< lambda of the fine order [1/s^2], ascending
    /// Fine vector k is P X from.col(k) + W along.col(k), X the coarse vectors.
    Eigen::MatrixXd from, along;
    RowMatrix correction; ///< W
    int steps = 0;        ///< of conjugate gradients, the most of any batch
};

/// One step of preconditioned inverse iteration for all vectors together: W solves K W = residual
/// on the fine order by TwoLevel, and Rayleigh-Ritz on [P X, W] gives values that are exact to the
/// second order in what W misses. Rigid motions are projected out of W. The last pairs of the
/// coarse basis lack neighbours to mix with: give some guards that are not used.
/// @param coarse  solved, its factor in place
/// @param fine    same mesh and supports, one order higher; not solved
/// @param share   see TwoLevel::solve
Refined refine(const ModalProblem& coarse, const EigenPairs& pairs, const ModalProblem& fine,
               double share = 0.03, const std::function<void(double)>& progress = {});

} // namespace ode::soft
