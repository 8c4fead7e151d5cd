#pragma once

#include "mesh/tet_mesh.h"

namespace ode::soft {

/// The same solid in quadratic elements with straight edges: mid-edge nodes follow the corner
/// nodes, in the order in which elements first use their edges. A quadratic mesh is returned as it
/// is.
TetMesh promote_to_quadratic(const TetMesh& mesh);

/// The linear mesh that a promoted one was made of: its corners, in their order.
/// @param mesh     from promote_to_quadratic(), its mid-edge nodes moved or not.
/// @param corners  nodes of the linear mesh.
TetMesh demote_to_linear(const TetMesh& mesh, std::size_t corners);

} // namespace ode::soft
