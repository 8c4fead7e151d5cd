#pragma once

#include "base/types.h"

#include <span>
#include <vector>

namespace ode::soft {

/// Lagrange basis of order 1 to 4 on the unit tetrahedron, by barycentric coordinates.
///
/// Nodes: the four corners; then of each edge (order of kTetEdge) its inner points, those nearer
/// the edge's first corner first; then of each face (order of kTetFace), for order 3 its centroid,
/// for order 4 its three inner points, each nearest to one corner, in the face's order; then, for
/// order 4, the centroid of the element. Order 2 is the node order of TetMesh.
constexpr int lagrange_nodes(int order) noexcept {
    return (order + 1) * (order + 2) * (order + 3) / 6;
}
/// Of them inside one face.
constexpr int lagrange_face_nodes(int order) noexcept { return (order - 1) * (order - 2) / 2; }
constexpr int kMaxOrder = 4;
constexpr int kMaxLagrangeNodes = lagrange_nodes(kMaxOrder);

using Barycentric = Eigen::Vector4d; ///< sums to one

/// Basis functions at a point; `value` holds lagrange_nodes(order) numbers.
void lagrange_value(int order, const Barycentric& at, std::span<double> value);

/// Derivatives with respect to the local coordinates (L1, L2, L3), L0 = 1 - L1 - L2 - L3: one
/// column a node.
void lagrange_gradient(int order, const Barycentric& at, Eigen::Matrix3Xd& gradient);

/// Barycentric coordinates of the nodes.
std::vector<Barycentric> lagrange_points(int order);

/// A weight is a part of the unit tetrahedron's volume, 1/6.
struct QuadraturePoint {
    Barycentric at;
    double weight;
};

/// Symmetric rule that is exact for polynomials up to `degree` (<= 6): 1, 4, 14 points (Walkington
/// 2000) or 24 (Keast 1986, doi:10.1016/0045-7825(86)90059-9); above, a conical product of
/// Gauss-Legendre rules.
std::vector<QuadraturePoint> tetrahedron_quadrature(int degree);

} // namespace ode::soft
