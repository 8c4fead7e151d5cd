#pragma once

#include "mesh/tet_mesh.h"

#include <array>

namespace ode::soft {

/// The nodes of Lagrange elements of order 1 to 4 over a mesh's tetrahedra, numbered without
/// regard to the order of the mesh itself: corners first, then edges, then faces, then insides.
struct DofMap {
    int order = 2;
    int nodes_per_element = 10;
    std::vector<int> element;   ///< nodes_per_element each, in the order of lagrange.h
    std::vector<Vec3> position; ///< through the mesh's own (linear or quadratic) geometry [m]
    /// A value at mesh node i is the sum of weight * value at node over the terms
    /// [mesh_start[i], mesh_start[i+1]); no term: the mesh node belongs to no element.
    struct Term {
        int node;
        double weight;
    };
    std::vector<int> mesh_start;
    std::vector<Term> mesh_term;

    std::size_t node_count() const noexcept { return position.size(); }
    std::size_t element_count() const noexcept {
        return element.size() / static_cast<std::size_t>(nodes_per_element);
    }
    std::span<const int> nodes_of(std::size_t e) const noexcept {
        const auto n = static_cast<std::size_t>(nodes_per_element);
        return std::span<const int>(element).subspan(e * n, n);
    }
};

DofMap number_nodes(const TetMesh& mesh, int order);

/// Where the linear functions vanish that are zero at the given mesh nodes: a corner in the list,
/// an edge or face all of whose corners (and, on a quadratic mesh, mid nodes) are. One flag a node.
/// @throws InputError for an index outside the mesh.
std::vector<char> clamped_nodes(const TetMesh& mesh, const DofMap& map,
                                std::span<const int> mesh_nodes);

/// Values of a lower order's functions at the nodes of a higher one on the same mesh: the functions
/// of order p are among those of p + 1. Terms as in DofMap::mesh_term, one range a fine node.
struct Prolongation {
    std::vector<int> start;
    std::vector<DofMap::Term> term;
};
Prolongation prolongate(const DofMap& coarse, const DofMap& fine);

} // namespace ode::soft
