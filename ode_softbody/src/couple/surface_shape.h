#pragma once

#include "base/types.h"
#include "mesh/tet_mesh.h"

#include <array>
#include <vector>

namespace ode::soft {

struct SurfaceNodes;

/// The smooth surface that a mesh's facets stand for, at rest. Entries run parallel to
/// SurfaceNodes::node, those of `bulge` to its triangles.
struct SurfaceShape {
    /// Round enough to meet a flat face in a point.
    bool bulges(std::size_t i) const noexcept { return curvature[i][1] > 0.1 * curvature[i][0]; }

    /// Principal curvatures, the larger first, positive where the surface bulges; zeros at sharp
    /// edges, where a mesh doesn't tell [1/m].
    std::vector<std::array<double, 2>> curvature;
    std::vector<Vec3> normal; ///< outward, in the rest frame
    /// Height of the curved surface over the facet at corner weights w: sum of w_j w_k bulge_i over
    /// the sides, each opposite corner i [m]; 0 where an end doesn't bulge.
    std::vector<std::array<double, 3>> bulge;
    double highest = 0; ///< that height, at most, anywhere [m]
};

SurfaceShape measure_shape(const TetMesh& mesh, const SurfaceNodes& surface);

} // namespace ode::soft
