#pragma once

#include "mesh/tet_mesh.h"

#include <array>
#include <cstdint>

namespace ode::soft {

/// One face of one element.
struct ElementFace {
    std::array<int, 3> corner; ///< ascending: equal for the elements that share the face
    int element;
    std::int8_t local; ///< kTetFace row
    bool even;         ///< outward winding is an even permutation of `corner`
};

/// All faces of all elements, those that share a face side by side, then by element. The mesh's
/// indices must be in range.
std::vector<ElementFace> sort_faces(const TetMesh& mesh);

/// The edges of a mesh, each once, numbered in the order in which elements first use them.
struct EdgeList {
    std::vector<std::array<int, 2>> edge; ///< corner nodes, ascending
    std::vector<int> of_element;          ///< six an element, in the order of kTetEdge
};

EdgeList number_edges(const TetMesh& mesh);

} // namespace ode::soft
