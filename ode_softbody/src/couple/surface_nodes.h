#pragma once

#include "mesh/surface.h"
#include "mesh/tet_mesh.h"

#include <span>
#include <vector>

namespace ode::soft {

/// What contact knows of a body's surface nodes, from the rest shape. Arrays run parallel.
struct SurfaceNodes {
    SurfaceNodes() = default;
    /// @param mass  of every mesh node [kg].
    SurfaceNodes(const TetMesh& mesh, const Surface& surface, std::span<const double> mass);

    std::vector<int> node;    ///< mesh node, ascending
    std::vector<double> area; ///< a third of each adjoining triangle [m^2]
    std::vector<double> mass; ///< [kg]
    double mean_edge = 0;     ///< of the surface triangles [m]
    double mass_per_area = 0; ///< median over the nodes [kg/m^2]
};

} // namespace ode::soft
