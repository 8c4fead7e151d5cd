#pragma once

#include "collide/aabb.h"
#include "collide/convex_faces.h"
#include "collide/rigid_pose.h"

#include <ode/collision.h>

#include <optional>
#include <span>

namespace ode::soft {

enum class ShapeKind {
    plane,
    sphere,
    box,
    capsule,
    cylinder,
    convex, ///< its owner has to give it `corners` and `faces`
    probed  ///< trimesh, height field: no distance of ours, ODE is asked (SurfaceProbe)
};

/// Distance from a shape's surface, negative inside, and its gradient, which is the outward normal
/// at the closest surface point.
struct SurfaceDistance {
    double distance; ///< [m]
    Vec3 normal;     ///< unit
};

/// What substeps know of a rigid geom: a snapshot that outlives any change to the geom, so that
/// evaluating it calls nothing of ODE. Valid for one step.
struct RigidShape {
    ShapeKind kind = ShapeKind::plane;
    /// [m] box: half sides; sphere: x radius; capsule and cylinder: x radius, z half length of the
    /// axis (a capsule's without its caps). Plane: none.
    Vec3 size = Vec3::Zero();
    /// In the body's frame, or in the world's when the geom has no body. The plane is the local
    /// z = 0 with the solid below it.
    Pose pose;
    dBodyID body = nullptr;
    dGeomID probe = nullptr; ///< convex, probed: the geom to ask; it has to outlive the snapshot
    std::span<const Vec3> corners;       ///< of a convex, from convex_corners(); borrowed
    std::span<const TangentPlane> faces; ///< of a convex, from hull_faces(); borrowed

    /// Not for probed kinds. Exact everywhere, inside and out, on edges and at corners; at points
    /// where several surface points are closest, one of them. About 10 ns. @param p  in the shape's
    /// own frame [m].
    SurfaceDistance distance(const Vec3& p) const noexcept;

    /// @param body  pose of the geom's body (identity without one). @param world  point [m].
    /// @return the normal in the world's frame.
    SurfaceDistance distance_at(const Pose& body_pose, const Vec3& world) const noexcept;

    /// Largest n.x of the shape's points x, in its own frame. @param n  unit.
    double support(const Vec3& n) const noexcept;

    /// Box that holds the shape; those of planes, convex and probed kinds are unbounded.
    Aabb bounds(const Pose& body_pose) const noexcept;
};

/// Takes the snapshot. Geoms with an offset and geoms inside a geom transform are placed as ODE
/// places them.
/// @return nothing for a kind that bears nothing (rays, spaces, soft geoms, other user classes) and
/// for sizes or poses that are not finite.
std::optional<RigidShape> capture_shape(dGeomID geom) noexcept;

} // namespace ode::soft
