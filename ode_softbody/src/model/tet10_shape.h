#pragma once

#include "base/types.h"

#include <array>

namespace ode::soft {

/// Shapes of the quadratic tetrahedron in the corner coordinates L0..L3, nodes as in TetMesh:
/// L_a (2 L_a - 1) at corners, 4 L_a L_b between them.
using Shapes10 = Eigen::Matrix<double, 10, 1>;
using Gradients10 = Eigen::Matrix<double, 10, 3>;

Shapes10 tet10_shapes(const Eigen::Vector4d& l) noexcept;

/// Derivatives by L1, L2, L3, L0 = 1 - L1 - L2 - L3.
Gradients10 tet10_gradients(const Eigen::Vector4d& l) noexcept;

/// The fourteen-point rule of degree 5 with positive weights (Grundmann-Moeller/Walkington family;
/// Keast 1986, doi:10.1016/0045-7825(86)90059-9): products of shapes over a straight element are of
/// degree 4. Weights sum to one.
struct TetPoint {
    Eigen::Vector4d l;
    double weight;
};
const std::array<TetPoint, 14>& tet_rule_of_degree_5();

} // namespace ode::soft
