#pragma once

#include "modal/block_system.h"
#include "modal/dissect.h"

#include <functional>

namespace ode::soft {

/// Multifrontal factor L D L^T of K + shift M (Duff and Reid 1983, doi:10.1145/356044.356047) on
/// the pieces of a dissection: dense blocks throughout, so that it runs at the speed of dense
/// algebra, five to ten times Eigen's simplicial Cholesky at 20 000 unknowns.
///
/// D isn't pivoted: safe for shift >= 0 on a body without free motion, and for shift < 0 good
/// enough to count the eigenvalues below -shift, unless one of them is hit to ten digits.
class BlockFactor {
public:
    /// Symbolic part. `system` is borrowed for the call only.
    explicit BlockFactor(const BlockSystem& system);

    /// @param keep      false: count pivots only and store no factor
    /// @param progress  called with the share done in [0, 1]; false abandons the work
    /// @return false if abandoned.
    bool factorise(const BlockSystem& system, double shift, bool keep = true,
                   const std::function<bool(double)>& progress = {});

    /// Of the last factorise(): by Sylvester's law, the eigenvalues of (K, M) below -shift.
    Eigen::Index negative_pivots() const noexcept { return negative_pivots_; }

    /// Overwrites x with (K + shift M)^-1 x.
    void solve(RowMatrix& x) const;

    /// The 3x3 blocks on the diagonal of (K + shift M)^-1, node by node: some three times the cost
    /// of factorise(), where solving for them would take a solve each.
    std::vector<Eigen::Matrix3d> inverse_diagonal() const;

    double factor_entries() const noexcept { return entries_; } ///< numbers stored
    double factor_flops() const noexcept { return flops_; }     ///< multiplications and additions

private:
    struct Front {
        int first, last;           ///< own nodes, by position in the order
        std::vector<int> boundary; ///< later positions that the front touches, ascending
        std::vector<int> child;
        Eigen::MatrixXd own;   ///< unit lower L11, with D on its diagonal
        Eigen::MatrixXd below; ///< L21
    };
    Eigen::MatrixXd gather(const BlockSystem& system, double shift, const Front& front,
                           std::vector<Eigen::MatrixXd>& update) const;

    std::vector<int> order_, position_;
    std::vector<Front> front_;
    mutable std::vector<int> local_; ///< scratch: place of a position in the current front
    Eigen::Index negative_pivots_ = 0;
    double entries_ = 0, flops_ = 0;
};

} // namespace ode::soft
