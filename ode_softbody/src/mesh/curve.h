#pragma once

#include "mesh/tet_mesh.h"

#include <cstddef>
#include <numbers>

namespace ode::soft {

struct CurveOptions {
    /// Dihedral of facets from which their edge is meant to be sharp [rad].
    double crease_angle = 50.0 * std::numbers::pi / 180.0;
    /// relative_jacobian() that every element keeps; offsets shrink until it does.
    double least_jacobian = 0.15;
};

struct CurveReport {
    std::size_t surface_edges = 0;
    std::size_t moved = 0;   ///< edges that are curved now
    std::size_t limited = 0; ///< edges whose offset least_jacobian cut down
    /// Edges of dihedral 35 to 80 degrees: a round made of fewer than about ten facets looks like
    /// this, and neither taking it for sharp nor for smooth gives its curvature back.
    std::size_t doubtful = 0;
};

/// Gives a body of flat facets its curved surface back, without knowing where it came from: the
/// mid-edge nodes of surface edges move by the sagitta (d/2) tan(phi/2) of the circle that leaves
/// the chord d at the angle phi, which the vertex normals of the smooth surface tell; along creases
/// their tangents do. Where one end's normal is poorly known, on a rim, the other's is mirrored.
/// Corner nodes and edges of flat facets keep their bits.
///
/// Valid for facets that resolve the curvature: at least ten round a circle.
/// @param mesh  quadratic with straight edges, as promote_to_quadratic() makes it
/// @throws InputError when mesh.order is not 2.
CurveReport curve_surface(TetMesh& mesh, const CurveOptions& options = {});

} // namespace ode::soft
