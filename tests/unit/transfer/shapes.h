#pragma once

#include "transfer/boundary.h"

namespace ode::sound::test {

/// Sphere of radius 1: an icosahedron, each triangle cut in four `level` times.
BoundaryMesh sphere(int level);

/// Flat cylinder of radius 1 about z, `thickness` high, `rings` rings of triangles a face.
BoundaryMesh disc(double thickness, int rings);

/// Shell of a half sphere of radius 1, pole on +z, from disc(), its rings even.
BoundaryMesh bowl(double thickness, int rings);

/// Block between -size/2 and size/2, cells of squares cut in two.
BoundaryMesh block(const Vec3& size, const std::array<int, 3>& cells);

} // namespace ode::sound::test
