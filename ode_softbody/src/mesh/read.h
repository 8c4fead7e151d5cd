#pragma once

#include "mesh/tet_mesh.h"

#include <string>

namespace ode::soft {

/// Reads a tetrahedral mesh; the file name's ending chooses the format: Gmsh .msh (2.2 and 4.1,
/// ASCII and binary), TetGen .node or .ele (the pair), legacy .vtk (ASCII and binary), Medit .mesh.
/// The mesh returned has passed check_mesh().
/// @throws InputError: one sentence naming file, line (or byte offset) and cure.
TetMesh read_mesh(const std::string& path);

} // namespace ode::soft
