#pragma once

#include "couple/surface_shape.h"
#include "mesh/surface.h"
#include "mesh/tet_mesh.h"

#include <array>
#include <span>
#include <vector>

namespace ode::soft {

/// How a point contact's surface yields at each node, at rest (measure_elasticity()). Entries run
/// parallel to SurfaceNodes::node.
struct PointElasticity {
    bool known() const noexcept { return !modulus.empty(); }
    std::vector<double> modulus; ///< E / (1 - nu^2), of the softest solid there [Pa]
    std::vector<double>
        compliance; ///< of the mesh, as part of a half-space, to a normal load [m/N]
    std::vector<double> relaxation; ///< beta of the same solid [s]
    std::vector<int> place;         ///< of each mesh node in the arrays above; -1: inside
};

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
    std::vector<std::array<double, 3>> side;  ///< length opposite each corner, at rest [m]
    std::vector<double> lightest;             ///< least nodal mass of each triangle [kg]

    SurfaceShape shape;
    PointElasticity elastic; ///< empty: contacts are springs as stiff as the substep allows
    /// What each mesh node yields along its normal that its motion doesn't show, because it moves
    /// in few modes [m/N]; empty: nothing.
    std::vector<double> residual;
    std::vector<double> residual_across; ///< the same, to a force along the surface

    /// Triangles round a mesh node.
    std::span<const int> fan(int mesh_node) const noexcept {
        const auto n = static_cast<std::size_t>(mesh_node);
        return std::span(fan_).subspan(fan_start_[n], fan_start_[n + 1] - fan_start_[n]);
    }

    double residual_at(int of_triangle, const Vec3& weight) const noexcept {
        return weighted(residual, of_triangle, weight);
    }
    double residual_across_at(int of_triangle, const Vec3& weight) const noexcept {
        return weighted(residual_across, of_triangle, weight);
    }

private:
    double weighted(const std::vector<double>& of_node, int of_triangle,
                    const Vec3& weight) const noexcept {
        double sum = 0;
        for (std::size_t i = 0; !of_node.empty() && i < 3; ++i)
            sum += weight[static_cast<int>(i)] *
                   of_node[static_cast<std::size_t>(
                       triangle[static_cast<std::size_t>(of_triangle)][i])];
        return sum;
    }

    std::vector<std::size_t> fan_start_; ///< per mesh node, into fan_
    std::vector<int> fan_;
};

} // namespace ode::soft
