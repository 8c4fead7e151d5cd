#pragma once

#include "collide/box_tree.h"
#include "couple/surface_nodes.h"

#include <array>
#include <span>
#include <vector>

namespace ode::soft {

/// A point fixed to a body's surface: a node, or the middle of a crease.
struct SurfacePoint {
    std::array<int, 2> node;      ///< of the mesh
    std::array<double, 2> weight; ///< sum to one; the second is 0 for a node
    double area;                  ///< that it stands for [m^2]
    double mass;                  ///< of its nodes that it may load [kg]

    Vec3 in(const NodeArray& field) const noexcept {
        Vec3 x = weight[0] * field[static_cast<std::size_t>(node[0])];
        if (weight[1] != 0)
            x += weight[1] * field[static_cast<std::size_t>(node[1])];
        return x;
    }
};

/// What contact with other soft surfaces needs of a body, made when it first meets one.
///
/// Points are the surface's nodes and the middles of its convex creases (more than 30 degrees at
/// rest): where two edges cross, the nodes of neither are inside the other. Area and mass of a
/// node are shared out among its own point and its creases'.
class SoftSurface {
public:
    /// @param nodes  borrowed. @param rest  positions of all mesh nodes; borrowed.
    SoftSurface(const SurfaceNodes& nodes, std::span<const Vec3> rest);

    const SurfaceNodes& nodes() const noexcept { return nodes_; }
    std::span<const Vec3> rest() const noexcept { return rest_; }
    std::span<const SurfacePoint> points() const noexcept { return point_; }

    /// Over the triangles, boxes as of the last refit().
    const BoxTree& tree() const noexcept { return tree_; }
    /// @param when  names the state of motion: twice the same costs nothing.
    void refit(const NodeArray& position, unsigned long when) noexcept;

private:
    const SurfaceNodes& nodes_;
    std::span<const Vec3> rest_;
    std::vector<SurfacePoint> point_;
    BoxTree tree_;
    unsigned long fitted_ = 0;
};

} // namespace ode::soft
