#pragma once

#include "base/types.h"
#include "model/solid.h"
#include "model/tet_kernel.h"

namespace ode::soft {

/// Elements of one slab, solid and shape in a list of packs.
struct TetBlock {
    std::size_t slab; ///< see order_elements()
    Solid solid;
    TetShape shape;
    std::size_t first; ///< pack
    std::size_t packs;
    std::size_t elements; ///< without the filling of the last pack
};

/// One element, unpacked: shapes at its integration points.
template <int kNodeCount, int kPointCount>
struct TetElement {
    static constexpr int kNodes = kNodeCount;
    static constexpr int kPoints = kPointCount;

    int node[kNodes];
    Eigen::Matrix<double, kNodes, 3> gradient[kPoints]; ///< dN/dX [1/m]
    double weight[kPoints]; ///< volumes that add up to the element's [m^3]
};

/// F = sum x_a (x) grad N_a, of differences to node 0: absolute positions would cost digits.
template <class Element>
Mat3 deformation_gradient(const Element& element, int point, const NodeArray& position) noexcept {
    Mat3 f = Mat3::Zero();
    for (int a = 1; a < Element::kNodes; ++a)
        f += (position[static_cast<std::size_t>(element.node[a])] -
              position[static_cast<std::size_t>(element.node[0])]) *
             element.gradient[point].row(a);
    return f;
}

} // namespace ode::soft
