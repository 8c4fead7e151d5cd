#pragma once

#include "mesh/tet_mesh.h"

namespace ode::soft {

/// Shapes for tests, demos and first programs. Lengths in metres, linear tetrahedra, centred on
/// the origin unless said otherwise.
/// @throws InputError when a length is not finite and positive, a count is not positive, or the
/// mesh
///         would have more than kMostGeneratedElements.

inline constexpr double kMostGeneratedElements = 2e7; ///< about 2 GB while a mesh is checked

/// Box of size x*y*z cut into nx*ny*nz cells of six tetrahedra round a body diagonal, mirrored from
/// cell to cell so that no direction is stiffer than its mirror image.
TetMesh make_box(const Vec3& size, int nx, int ny, int nz);

/// Bar from x = 0 to x = length, width along y, thickness along z.
TetMesh make_bar(double length, double width, double thickness, int nx, int ny, int nz);

/// Plate in the xy plane, thickness along z.
TetMesh make_plate(double length, double width, double thickness, int nx, int ny, int nz);

/// Spherical cap, open at the top (+z): a shell of outer radius `radius` between the polar angle 0
/// (its lowest point, at z = -radius) and `opening` [rad].
/// Ring r has around * r / rings nodes, so that no triangle is thin at the pole: around = 6 rings
/// makes six equal sectors. rings = 8, around = 48, layers = 1 gives 434 nodes, 1152 elements.
/// @param opening    below pi
/// @param rings      elements from the pole to the rim
/// @param around     elements round the axis at the rim, at least 3
/// @param layers     elements through the thickness
TetMesh make_bowl(double radius, double thickness, double opening, int rings, int around,
                  int layers);

/// Tube along z from 0 to length. around: at least 3.
TetMesh make_tube(double length, double outer_radius, double inner_radius, int along, int around,
                  int layers);

/// Solid sphere of 20 refinement^3 elements: an icosahedron's cones, cut regularly, their layers
/// pushed out to spheres. `refinement` elements from the centre to the surface.
TetMesh make_sphere(double radius, int refinement);

} // namespace ode::soft
