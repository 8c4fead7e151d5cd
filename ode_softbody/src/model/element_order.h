#pragma once

#include "mesh/tet_mesh.h"

#include <vector>

namespace ode::soft {

inline constexpr std::size_t kMostSlabs = 32; ///< enough for 16 threads

/// Elements whose forces are added up one after the other, sorted by their solid.
struct ElementSlab {
    std::vector<std::vector<int>> of_solid; ///< one list a solid; empty ones are possible
};

/// The order in which a model goes through the elements of a mesh.
///
/// Within a slab each solid's are sorted by their least node number: the nodes that an element
/// reads and writes then move through memory in step with the list. (A space-filling curve through
/// the centroids is twice as slow on 384 k elements whose nodes are numbered row by row: nodes
/// cannot be moved, and a curve jumps between their pages.)
///
/// Small meshes are one slab. Others are cut into slabs of equal size such that every other one has
/// no node in common: all even ones may be added up side by side, then all odd ones. The cut
/// depends on the mesh alone, and so does the sum.
/// @param least  elements that a slab has at least.
/// @return an even number of slabs, or one.
/// @throws InputError when a group has no solid.
std::vector<ElementSlab> order_elements(const TetMesh& mesh, std::size_t solids, std::size_t least);

} // namespace ode::soft
