#pragma once

#include "modal/dof_map.h"
#include "modal/single_stiffness.h"

#include <functional>

namespace ode::soft {

/// Moves vectors between the free nodes of two orders on one mesh.
class Transfer {
public:
    /// @param coarse_held, fine_held  as in free_rigid_motions
    Transfer(const DofMap& coarse, const std::vector<char>& coarse_held, const DofMap& fine,
             const std::vector<char>& fine_held);

    /// fine = P coarse: the same function. Of RowMatrix or RowMatrixF.
    template <typename Matrix>
    void up(const Matrix& coarse, Matrix& fine) const;
    /// coarse = P^T fine: the same work.
    template <typename Matrix>
    void down(const Matrix& fine, Matrix& coarse) const;

private:
    std::vector<int> start_; ///< terms of a fine free node
    std::vector<DofMap::Term> term_;
    Eigen::Index coarse_nodes_ = 0;
};

/// Overwrites a right-hand side with K^-1 of it, exactly or nearly, on the order below.
using CoarseInverse = std::function<void(RowMatrixF&)>;

/// Approximate inverse of a fine stiffness: a symmetric cycle of Chebyshev smoothing over 3x3 node
/// blocks (Adams et al. 2003, doi:10.1016/S0021-9991(03)00194-3) round a solve on the coarse order:
/// its factor, or a TwoLevel in turn. The fine matrix is multiplied, never factorised, and within
/// the cycle in single precision. (Not outside of it: thin bodies need the residual in double.)
class TwoLevel {
public:
    /// Matrix and transfer are borrowed.
    TwoLevel(const BlockSystem& fine, const Transfer& transfer, CoarseInverse coarse);

    /// Conjugate gradients on K w = r, each column by itself, from zero, until the energy that a
    /// step adds falls below `share` of what the steps before gave, in every column.
    /// @param r  without component along rigid motions; overwritten
    /// @return steps taken.
    int solve(RowMatrix& r, RowMatrix& w, double share, int max_steps) const;

    /// One cycle: z is nearly K^-1 r. The two are different matrices.
    void cycle(const RowMatrixF& r, RowMatrixF& z) const;

private:
    void smooth(const RowMatrixF& r, RowMatrixF& z) const;
    void scale(const RowMatrixF& r, RowMatrixF& z) const; ///< by the inverse node blocks

    const BlockSystem& fine_;
    const Transfer& transfer_;
    CoarseInverse coarse_;
    SingleStiffness single_;
    std::vector<Eigen::Matrix3f> inverse_block_;
    double high_ = 0; ///< largest eigenvalue of the scaled stiffness, with a margin
    // Kept from call to call: some megabytes each.
    mutable RowMatrixF residual_, step_, scaled_; // of smooth()
    mutable RowMatrixF rest_, low_, correction_;  // of cycle()
    mutable RowMatrixF right_, cycled_single_;    // of solve()
    mutable RowMatrix cycled_, direction_, image_;
};

} // namespace ode::soft
