#include "collide/rigid_shape.h"

#include "collide/shape_distance.h"

#include <ode/objects.h>

#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

Pose pose_from(const dReal* position, const dReal* rotation) noexcept {
    Pose pose;
    for (int i = 0; i < 3; ++i) {
        pose.position[i] = position[i];
        for (int j = 0; j < 3; ++j)
            pose.rotation(i, j) = rotation[4 * i + j]; // dMatrix3: rows of four
    }
    return pose;
}

Pose inverse(const Pose& pose) noexcept {
    return {-(pose.rotation.transpose() * pose.position), pose.rotation.transpose()};
}

/// A frame at the foot of the plane's normal, z along it.
Pose plane_pose(dGeomID geom) noexcept {
    dVector4 params; // unit normal, distance from the origin
    dGeomPlaneGetParams(geom, params);
    const Vec3 normal(params[0], params[1], params[2]);
    Pose pose;
    pose.position = params[3] * normal;
    pose.rotation.col(2) = normal;
    pose.rotation.col(0) = normal.unitOrthogonal();
    pose.rotation.col(1) = normal.cross(pose.rotation.col(0));
    return pose;
}

/// Geom transforms are deprecated in favour of offsets, but applications have them.
dGeomID inner_geom(dGeomID geom) noexcept {
    if (dGeomGetClass(geom) != dGeomTransformClass)
        return geom;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
    return dGeomTransformGetGeom(geom);
#pragma GCC diagnostic pop
}

bool read_size(dGeomID geom, RigidShape& shape) noexcept {
    dReal radius = 0;
    dReal length = 0;
    dVector3 sides;
    switch (dGeomGetClass(geom)) {
    case dPlaneClass:
        shape.kind = ShapeKind::plane;
        return true;
    case dSphereClass:
        shape.kind = ShapeKind::sphere;
        shape.size.x() = dGeomSphereGetRadius(geom);
        return true;
    case dBoxClass:
        shape.kind = ShapeKind::box;
        dGeomBoxGetLengths(geom, sides);
        shape.size = Vec3(sides[0], sides[1], sides[2]) / 2;
        return true;
    case dCapsuleClass:
        shape.kind = ShapeKind::capsule;
        dGeomCapsuleGetParams(geom, &radius, &length);
        shape.size = Vec3(radius, 0, length / 2);
        return true;
    case dCylinderClass:
        shape.kind = ShapeKind::cylinder;
        dGeomCylinderGetParams(geom, &radius, &length);
        shape.size = Vec3(radius, 0, length / 2);
        return true;
    case dConvexClass:
        shape.kind = ShapeKind::convex;
        shape.probe = geom;
        return true;
    case dTriMeshClass:
    case dHeightfieldClass:
        shape.kind = ShapeKind::probed;
        shape.probe = geom;
        return true;
    default:
        return false;
    }
}

/// Half sides of the shape's box in its own frame.
Vec3 half_extent(const RigidShape& shape) noexcept {
    const Vec3& s = shape.size;
    switch (shape.kind) {
    case ShapeKind::sphere:
        return Vec3::Constant(s.x());
    case ShapeKind::box:
        return s;
    case ShapeKind::capsule:
        return {s.x(), s.x(), s.x() + s.z()};
    case ShapeKind::cylinder:
        return {s.x(), s.x(), s.z()};
    case ShapeKind::plane:
    case ShapeKind::convex:
    case ShapeKind::probed:
        break;
    }
    return Vec3::Constant(std::numeric_limits<double>::infinity());
}

} // namespace

SurfaceDistance RigidShape::distance(const Vec3& p) const noexcept {
    return with_distance(kind, [&](auto distance_of) { return distance_of(*this, p); });
}

SurfaceDistance RigidShape::distance_at(const Pose& body_pose, const Vec3& world) const noexcept {
    const Pose here = pose.in(body_pose);
    const SurfaceDistance local = distance(here.to_local(world));
    return {local.distance, here.rotation * local.normal};
}

double RigidShape::support(const Vec3& n) const noexcept {
    switch (kind) {
    case ShapeKind::sphere:
        return size.x();
    case ShapeKind::box:
        return size.dot(n.cwiseAbs());
    case ShapeKind::capsule:
        return size.x() + size.z() * std::fabs(n.z());
    case ShapeKind::cylinder:
        return size.x() * std::hypot(n.x(), n.y()) + size.z() * std::fabs(n.z());
    case ShapeKind::convex: {
        double farthest = -std::numeric_limits<double>::infinity();
        for (const Vec3& corner : corners)
            farthest = std::fmax(farthest, n.dot(corner));
        return farthest;
    }
    case ShapeKind::plane:
    case ShapeKind::probed:
        break;
    }
    return n.z() >= 1 ? 0 : std::numeric_limits<double>::infinity();
}

Aabb RigidShape::bounds(const Pose& body_pose) const noexcept {
    Aabb box;
    if (!half_extent(*this).allFinite()) {
        const double all = std::numeric_limits<double>::infinity();
        box.include(Vec3::Constant(all));
        box.include(Vec3::Constant(-all));
        return box;
    }
    const Pose here = pose.in(body_pose);
    const Vec3 half = here.rotation.cwiseAbs() * half_extent(*this);
    box.include(here.position - half);
    box.include(here.position + half);
    return box;
}

std::optional<RigidShape> capture_shape(dGeomID geom) noexcept {
    RigidShape shape;
    const dGeomID inner = inner_geom(geom);
    if (!inner)
        return {};
    if (!read_size(inner, shape))
        return {};
    if (shape.probe && inner != geom)
        return {}; // ODE can't be asked about a geom inside a transform without moving it
    shape.body = dGeomGetBody(geom);
    if (shape.kind == ShapeKind::plane)
        shape.pose = plane_pose(inner);
    else if (shape.body && inner == geom && !dGeomIsOffset(geom))
        shape.pose = Pose{}; // exactly the body's frame
    else {
        Pose world = pose_from(dGeomGetPosition(geom), dGeomGetRotation(geom));
        if (inner != geom)
            world = pose_from(dGeomGetPosition(inner), dGeomGetRotation(inner)).in(world);
        shape.pose = shape.body ? world.in(inverse(pose_from(dBodyGetPosition(shape.body),
                                                             dBodyGetRotation(shape.body))))
                                : world;
    }
    const bool finite = shape.size.allFinite() && shape.pose.position.allFinite() &&
                        shape.pose.rotation.allFinite();
    return finite ? std::optional(shape) : std::nullopt;
}

} // namespace ode::soft
