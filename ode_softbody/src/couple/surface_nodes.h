#pragma once

#include "mesh/surface.h"
#include "mesh/tet_mesh.h"

#include <array>
#include <span>
#include <vector>

namespace ode::soft {

/// What contact knows of a body's surface, from the rest shape. The first arrays run parallel, one
/// entry a surface node.
struct SurfaceNodes {
    SurfaceNodes() = default;
    /// @param mass  of every mesh node [kg].
    SurfaceNodes(const TetMesh& mesh, const Surface& surface, std::span<const double> mass);

    std::vector<int> node;    ///< mesh node, ascending
    std::vector<double> area; ///< a third of each adjoining triangle [m^2]
    std::vector<double> mass; ///< [kg]
    double mean_edge = 0;     ///< of the surface triangles [m]
    double mass_per_area = 0; ///< median over the nodes [kg/m^2]

    std::vector<std::array<int, 3>> triangle; ///< mesh nodes, outward
    std::vector<double> lightest;             ///< least nodal mass of each triangle [kg]

    /// Triangles round a mesh node.
    std::span<const int> fan(int mesh_node) const noexcept {
        const auto n = static_cast<std::size_t>(mesh_node);
        return std::span(fan_).subspan(fan_start_[n], fan_start_[n + 1] - fan_start_[n]);
    }

private:
    std::vector<std::size_t> fan_start_; ///< per mesh node, into fan_
    std::vector<int> fan_;
};

} // namespace ode::soft
