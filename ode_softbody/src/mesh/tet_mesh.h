#pragma once

#include "base/types.h"

#include <span>
#include <string>
#include <vector>

namespace ode::soft {

/// A tetrahedral mesh as the user gave it. From arrays, nodes keep their index; from a file they
/// come in the order of their numbers there, less those that no tetrahedron uses (Gmsh writes such
/// nodes for construction points): a file without them, numbered 1..n, has its node k at index k-1.
///
/// Linear elements list their corners 0 1 2 3 with (x1-x0) x (x2-x0) . (x3-x0) > 0; quadratic ones
/// append the mid-edge nodes of edges 01 12 20 03 13 23, in this order.
struct TetMesh {
    int order = 1;            ///< 1: 4 nodes an element, 2: 10
    std::vector<Vec3> node;   ///< reference position [m]
    std::vector<int> element; ///< node indices, nodes_per_element() each
    std::vector<int> group;   ///< index into group_name, one an element; empty: one solid
    std::vector<std::string> group_name; ///< physical groups

    int nodes_per_element() const noexcept { return order == 1 ? 4 : 10; }
    std::size_t element_count() const noexcept {
        return element.size() / static_cast<std::size_t>(nodes_per_element());
    }
    std::span<const int> nodes_of(std::size_t e) const noexcept {
        const auto n = static_cast<std::size_t>(nodes_per_element());
        return std::span<const int>(element).subspan(e * n, n);
    }
};

/// Edges of a tetrahedron in the order of the mid-edge nodes 4..9.
inline constexpr int kTetEdge[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/// Mid-edge node between two corners; the diagonal means nothing.
inline constexpr int kTetMid[4][4] = {{-1, 4, 6, 7}, {4, -1, 5, 8}, {6, 5, -1, 9}, {7, 8, 9, -1}};

/// Faces of a positively oriented tetrahedron, corners counter-clockwise seen from outside;
/// face i lies opposite corner i.
inline constexpr int kTetFace[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

} // namespace ode::soft
