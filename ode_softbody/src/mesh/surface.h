#pragma once

#include "mesh/tet_mesh.h"

#include <array>

namespace ode::soft {

/// The boundary of a mesh: every element face that no second element shares.
struct Surface {
    std::vector<std::array<int, 3>> triangle; ///< mesh nodes, outward by the right-hand rule
    std::vector<int> node;                    ///< nodes that some triangle uses, ascending
};

/// Triangles come in the order of their elements; a quadratic face gives four triangles over its
/// corners and mid-edge nodes.
/// @throws InputError when a face belongs to more than two elements.
Surface extract_surface(const TetMesh& mesh);

} // namespace ode::soft
