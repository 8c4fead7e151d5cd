#pragma once

#include "modal/modal_problem.h"
#include "modal/two_level.h"

namespace ode::soft {

/// Modes of the next order up, from those of the order below on the same mesh.
struct Refined {
    Eigen::VectorXd value; ///< lambda of the fine order [1/s^2], ascending
    /// Fine vector k is P X from.col(k) + W along.col(k), X the coarse vectors.
    Eigen::MatrixXd from, along;
    RowMatrix correction; ///< W
    int steps = 0;        ///< of conjugate gradients, the most of any batch
};

/// How far K W = residual is solved.
struct Effort {
    double share; ///< see TwoLevel::solve
    int steps;    ///< at most
};

/// One step of preconditioned inverse iteration for all vectors together: W solves K W = residual
/// on the fine order, and Rayleigh-Ritz on [P X, W] gives values that are exact to the second order
/// in what W misses. Rigid motions are projected out of W. The last pairs of the coarse basis lack
/// neighbours to mix with: give some guards that are not used.
/// @param coarse   pairs of the order below on the same mesh and supports
/// @param fine     not solved
/// @param inverse  of the fine stiffness
Refined refine(const EigenPairs& coarse, const Transfer& transfer, const ModalProblem& fine,
               const TwoLevel& inverse, Effort effort,
               const std::function<void(double)>& progress = {});

} // namespace ode::soft
