#pragma once

#include "mesh/tet_mesh.h"

namespace ode::soft {

/// The same solid in quadratic elements with straight edges: mid-edge nodes follow the corner
/// nodes, in the order in which elements first use their edges. A quadratic mesh is returned as it
/// is.
TetMesh promote_to_quadratic(const TetMesh& mesh);

} // namespace ode::soft
