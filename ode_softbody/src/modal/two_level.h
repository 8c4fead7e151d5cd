#pragma once

#include "modal/block_factor.h"
#include "modal/dof_map.h"

namespace ode::soft {

/// Moves vectors between the free nodes of two orders on one mesh.
class Transfer {
public:
    /// @param coarse_held, fine_held  as in free_rigid_motions
    Transfer(const DofMap& coarse, const std::vector<char>& coarse_held, const DofMap& fine,
             const std::vector<char>& fine_held);

    /// fine = P coarse: the same function.
    void up(const RowMatrix& coarse, RowMatrix& fine) const;
    /// coarse = P^T fine: the same work.
    void down(const RowMatrix& fine, RowMatrix& coarse) const;

private:
    std::vector<int> start_; ///< terms of a fine free node
    std::vector<DofMap::Term> term_;
    Eigen::Index coarse_nodes_ = 0;
};

/// Approximate inverse of a fine stiffness: a symmetric cycle of Chebyshev smoothing over 3x3 node
/// blocks (Adams et al. 2003, doi:10.1016/S0021-9991(03)00194-3) round an exact solve on the
/// coarse order, whose factor is there already. The fine matrix is multiplied, never factorised.
class TwoLevel {
public:
    /// All borrowed. `coarse` is a factor of K + shift M with the shift small.
    TwoLevel(const BlockSystem& fine, const BlockFactor& coarse, const Transfer& transfer);

    /// Conjugate gradients on K w = r, each column by itself, from zero, until the energy that a
    /// step adds falls below `share` of what the steps before gave, in every column.
    /// @param r  without component along rigid motions; overwritten with the residual
    /// @return steps taken.
    int solve(RowMatrix& r, RowMatrix& w, double share, int max_steps) const;

private:
    void precondition(const RowMatrix& r, RowMatrix& z) const;
    void smooth(const RowMatrix& r, RowMatrix& z) const;
    void scale(const RowMatrix& r, RowMatrix& z) const; ///< by the inverse node blocks

    const BlockSystem& fine_;
    const BlockFactor& coarse_;
    const Transfer& transfer_;
    std::vector<Mat3> inverse_block_;
    double high_ = 0; ///< largest eigenvalue of the scaled stiffness, with a margin
    mutable RowMatrix residual_, step_, scaled_, low_, correction_;
};

} // namespace ode::soft
