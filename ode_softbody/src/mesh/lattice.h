#pragma once

#include "mesh/tet_mesh.h"

#include <array>
#include <string>

namespace ode::soft {

/// A block of nx*ny*nz cells of six tetrahedra each, mirrored in alternate cells, with node
/// (i, j, k) of (nx+1)(ny+1)(nz+1) at index i + (nx+1) (j + (ny+1) k); nodes are left at zero.
/// @param ring  joins j = ny to j = 0: there are ny nodes that way. With odd ny the cells are not
///              mirrored along j, so that the ends still fit.
TetMesh cut_lattice(const std::array<int, 3>& cells, bool ring);

/// What every generator asks of its arguments; `shape` names it in the sentence.
/// @throws InputError
void require_length(double value, const char* what, const char* shape);
void require_count(int value, int least, const char* what, const char* shape);
void require_size(double elements, const char* shape);

} // namespace ode::soft
