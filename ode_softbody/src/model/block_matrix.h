#pragma once

#include "base/types.h"

#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace ode::soft {

/// A sparse matrix of 3x3 blocks, one for every pair of nodes that share an element. The pattern is
/// laid out first and blocks are added in place: triplet lists need six times the memory.
class BlockMatrix {
public:
    /// @param element  node numbers, `corners` an element.
    BlockMatrix(std::span<const int> element, int corners, std::size_t nodes);

    /// Adds to block (row, column); both nodes must share an element.
    void add(int row, int column, const Mat3& block) noexcept;

    void set_zero() noexcept;

    /// 3n x 3n: xyz of node 0, node 1, ...
    const Eigen::SparseMatrix<double>& matrix() const noexcept { return matrix_; }
    Eigen::SparseMatrix<double>& matrix() noexcept { return matrix_; }
    /// Leaves this empty.
    Eigen::SparseMatrix<double> take() { return std::move(matrix_); }

private:
    std::vector<int> first_;     ///< of each node in neighbour_
    std::vector<int> neighbour_; ///< ascending for each node, itself included
    Eigen::SparseMatrix<double> matrix_;
};

} // namespace ode::soft
