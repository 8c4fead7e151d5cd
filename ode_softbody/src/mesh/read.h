#pragma once

#include "mesh/tet_mesh.h"

#include <string>
#include <string_view>

namespace ode::soft {

/// Readers of tetrahedral meshes. All of them
/// - take tetrahedra of 4 or 10 nodes (curved edges are kept), not both in a file; they ignore
///   points, lines and surfaces and refuse other volume elements;
/// - order nodes by their numbers in the file and drop those that no tetrahedron uses;
/// - turn the mesh round when *all* its elements are inverted (some programs count corners the
/// other
///   way), and refuse it when only some are;
/// - return a mesh that has passed check_mesh(), or none.
/// @throws InputError: one sentence naming file, line (byte for binary data) and cure. Its nodes
/// and
///         elements bear the file's numbers; in .vtk, which has none, they count from 0.

/// Chooses the format by the ending of the name: .msh, .node or .ele (the other is looked for
/// beside it), .vtk, .mesh.
TetMesh read_mesh(const std::string& path);

/// Gmsh .msh 2.2 and 4.1, ASCII and binary. Physical volumes become groups, by their names; of
/// several on one volume the first counts, and elements in none are in the group "none".
TetMesh read_gmsh(std::string_view bytes, const std::string& name);

/// TetGen .node and .ele, numbered from 0 or 1. The first attribute of the elements (the region)
/// becomes the group. Of the mid-edge nodes of 10-node elements each goes to the edge whose
/// midpoint it is nearest to, since versions of TetGen order them differently but always put them
/// there.
TetMesh read_tetgen(std::string_view node_bytes, const std::string& node_name,
                    std::string_view element_bytes, const std::string& element_name);

/// Legacy .vtk, versions 1 to 5, unstructured grid, ASCII and binary (big endian). No groups.
TetMesh read_vtk(std::string_view bytes, const std::string& name);

/// Medit .mesh, ASCII. References become groups.
TetMesh read_medit(std::string_view bytes, const std::string& name);

} // namespace ode::soft
