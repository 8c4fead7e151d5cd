#pragma once

#include "transfer/boundary.h"

namespace ode::sound {

/// A surface with fewer triangles, its nodes a part of the old ones.
struct Coarsened {
    BoundaryMesh mesh;
    std::vector<int> kept; ///< old number of every node
};

/// Collapses edges, the least change of shape first (M. Garland, P. Heckbert, "Surface
/// simplification using quadric error metrics", SIGGRAPH 1997), each to one of its ends, so that
/// whatever is known at the nodes stays known. Ends at `triangles` or where nothing more can go
/// without turning a facet over or gluing walls together.
Coarsened coarsen(const BoundaryMesh& mesh, std::size_t triangles);

/// Cuts each triangle in four; new nodes come after the old ones. @param parents  out: the ends of
/// the edge that each new node halves.
BoundaryMesh split(const BoundaryMesh& mesh, std::vector<std::array<int, 2>>& parents);

/// Whether every edge has exactly two triangles that run through it opposite ways.
bool is_closed(const BoundaryMesh& mesh);

} // namespace ode::sound
