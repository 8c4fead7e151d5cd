#pragma once

#include "mesh/tet_mesh.h"

#include <array>

namespace ode::soft {

/// Cuts an octahedron into four tetrahedra round its shortest diagonal and appends them to
/// `element`. Of diagonals equally short (symmetric shapes have them) it takes the one whose worst
/// tetrahedron has the best quality, then the first: Kuhn's tetrahedra then reproduce themselves.
/// @param opposite  three pairs of opposite nodes p_k, q_k with
///                  (p_1 - q_1) x (p_2 - q_2) . (p_3 - q_3) > 0.
void cut_octahedron(const std::vector<Vec3>& node,
                    const std::array<std::array<int, 2>, 3>& opposite, std::vector<int>& element);

} // namespace ode::soft
