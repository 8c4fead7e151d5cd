#pragma once

#include "mesh/tet_mesh.h"

#include <array>

namespace ode::soft {

/// The map from the reference tetrahedron to a quadratic element has a gradient that is linear in
/// the barycentric coordinates, J = sum l_i J_i with J_i its value at corner i, so that det J is a
/// cubic polynomial with the Bernstein coefficients
///     b_ijk = mean over the permutations of (i j k) of det[J_i e_1, J_j e_2, J_k e_3].
/// det J lies between the least and the greatest of them everywhere in the element (Johnen,
/// Remacle, Geuzaine 2013, doi:10.1016/j.jcp.2012.08.051), and they agree with it at the corners.
/// @return the 20 coefficients [m^3], corners first; a linear element has 20 equal ones.
std::array<double, 20> jacobian_bernstein(const TetMesh& mesh, std::size_t element);

/// Least Bernstein coefficient over six times the volume of the corner tetrahedron: 1 for straight
/// edges with nodes in their middle; above 0 means one-to-one everywhere.
double relative_jacobian(const TetMesh& mesh, std::size_t element);

/// Volume of an element [m^3], exact for curved ones; negative when inverted.
double element_volume(const TetMesh& mesh, std::size_t element);

} // namespace ode::soft
