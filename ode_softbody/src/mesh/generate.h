#pragma once

#include "mesh/tet_mesh.h"

namespace ode::soft {

/// Shapes for tests, demos and first programs. Lengths in metres, linear tetrahedra, centred on
/// the origin unless said otherwise.
/// @throws InputError when a length is not finite and positive or a count is not.

/// Box of size x*y*z cut into nx*ny*nz cells of six tetrahedra.
TetMesh make_box(const Vec3& size, int nx, int ny, int nz);

/// Bar from x = 0 to x = length, width along y, thickness along z.
TetMesh make_bar(double length, double width, double thickness, int nx, int ny, int nz);

/// Plate in the xy plane, thickness along z.
TetMesh make_plate(double length, double width, double thickness, int nx, int ny, int nz);

/// Spherical cap, open at the top (+z): a shell of outer radius `radius` between the polar angle 0
/// (its lowest point, at z = -radius) and `opening` [rad].
/// @param rings      elements from the pole to the rim
/// @param around     elements round the axis at the rim
/// @param layers     elements through the thickness
TetMesh make_bowl(double radius, double thickness, double opening, int rings, int around,
                  int layers);

/// Tube along z from 0 to length.
TetMesh make_tube(double length, double outer_radius, double inner_radius, int along, int around,
                  int layers);

/// Solid sphere. `refinement` cells from centre to surface.
TetMesh make_sphere(double radius, int refinement);

} // namespace ode::soft
