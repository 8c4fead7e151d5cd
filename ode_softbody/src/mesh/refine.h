#pragma once

#include "mesh/tet_mesh.h"

namespace ode::soft {

/// Cuts every element into eight through the middles of its edges: four at the corners and the
/// octahedron between them along its shortest diagonal, which keeps the shapes bounded under
/// repeated refinement (Bey 1995, doi:10.1007/BF02238487). Linear; groups are kept. The first nodes
/// are those of `mesh` and the elements 8e to 8e+7 come of element e.
///
/// A quadratic mesh is cut at its mid-edge nodes, wherever they are, and gives a linear mesh whose
/// nodes lie on the curved surface: refine_uniformly(curved) approaches the curved body, where
/// refining the linear mesh would only repeat its facets.
TetMesh refine_uniformly(const TetMesh& mesh);

} // namespace ode::soft
