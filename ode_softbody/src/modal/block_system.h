#pragma once

#include "base/types.h"

#include <vector>

namespace ode::soft {

/// A block of vectors, one row a degree of freedom (xyz of node 0, node 1, ...), one column a
/// vector. Rows are contiguous: sparse products and solves read a node's share of all vectors at
/// once.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Stiffness and mass of a linear elastic body at rest on one node-pair pattern. Both triangles are
/// stored; a node pair has a 3x3 block of stiffness and, since mass couples no directions, one
/// number of mass.
struct BlockSystem {
    std::vector<int> start;        ///< row of node i: pairs [start[i], start[i+1])
    std::vector<int> column;       ///< second node of a pair, ascending in a row
    std::vector<double> stiffness; ///< nine a pair, row by row [N/m]
    std::vector<double> mass;      ///< one a pair [kg]
    std::vector<Vec3> position;    ///< of the nodes [m]

    std::size_t node_count() const noexcept { return position.size(); }
    Eigen::Index size() const noexcept { return 3 * static_cast<Eigen::Index>(position.size()); }
};

/// y = K x and y = M x.
void multiply_stiffness(const BlockSystem& system, const RowMatrix& x, RowMatrix& y);
void multiply_mass(const BlockSystem& system, const RowMatrix& x, RowMatrix& y);

/// Rows and columns of the nodes with keep[i] != 0, in order: the others are held at zero.
BlockSystem restrict_to(const BlockSystem& system, const std::vector<char>& keep);

/// Pieces that share no node pair: an index from 0 for each node, in order of first node.
std::vector<int> connected_parts(const BlockSystem& system);

} // namespace ode::soft
