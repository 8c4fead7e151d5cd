#pragma once

#include "collide/rigid_shape.h"

#include <cmath>
#include <limits>

namespace ode::soft {

/// Signed distances of ODE's shapes in their own frames, inline for the substep's loop over nodes.
/// dGeomBoxPointDepth and its kin serve neither: they give no normal, and the box's is wrong
/// outside (ODE 0.16).

inline SurfaceDistance plane_distance(const Vec3&, const Vec3& p) noexcept {
    return {p.z(), Vec3::UnitZ()};
}

/// Distance from a point, less a radius. `away`: from the point.
inline SurfaceDistance rounded(const Vec3& away, double radius, const Vec3& otherwise) noexcept {
    const double length = away.norm();
    return {length - radius, length > 0 ? Vec3(away / length) : otherwise};
}

inline SurfaceDistance sphere_distance(const Vec3& size, const Vec3& p) noexcept {
    return rounded(p, size.x(), Vec3::UnitZ());
}

inline SurfaceDistance capsule_distance(const Vec3& size, const Vec3& p) noexcept {
    const double on_axis = std::fmax(-size.z(), std::fmin(size.z(), p.z()));
    return rounded(p - Vec3(0, 0, on_axis), size.x(), Vec3::UnitX());
}

inline SurfaceDistance box_distance(const Vec3& half, const Vec3& p) noexcept {
    const Vec3 q = p.cwiseAbs() - half;
    const Vec3 out = q.cwiseMax(0.0);
    const double length2 = out.squaredNorm();
    if (length2 > 0) {
        const double length = std::sqrt(length2);
        return {length, Vec3(std::copysign(out.x(), p.x()), std::copysign(out.y(), p.y()),
                             std::copysign(out.z(), p.z())) /
                            length};
    }
    if (q.x() >= q.y() && q.x() >= q.z())
        return {q.x(), Vec3(std::copysign(1.0, p.x()), 0, 0)};
    if (q.y() >= q.z())
        return {q.y(), Vec3(0, std::copysign(1.0, p.y()), 0)};
    return {q.z(), Vec3(0, 0, std::copysign(1.0, p.z()))};
}

/// A box in the half-plane (distance from the axis, |z|).
inline SurfaceDistance cylinder_distance(const Vec3& size, const Vec3& p) noexcept {
    const double from_axis = std::hypot(p.x(), p.y());
    const Vec3 radial =
        from_axis > 0 ? Vec3(p.x() / from_axis, p.y() / from_axis, 0) : Vec3::UnitX();
    const Vec3 axial(0, 0, std::copysign(1.0, p.z()));
    const double side = from_axis - size.x();
    const double cap = std::fabs(p.z()) - size.z();
    if (side > 0 && cap > 0) {
        const double length = std::hypot(side, cap);
        return {length, (side * radial + cap * axial) / length};
    }
    return side >= cap ? SurfaceDistance{side, radial} : SurfaceDistance{cap, axial};
}

/// From a point outside, beyond edges and corners too: to the closest point on edge or corner.
/// @param largest  the farthest plane's.
SurfaceDistance distance_to_hull(std::span<const TangentPlane> faces, const Vec3& p,
                                 const SurfaceDistance& largest) noexcept;

inline SurfaceDistance convex_distance(std::span<const TangentPlane> faces,
                                       const Vec3& p) noexcept {
    SurfaceDistance largest{-std::numeric_limits<double>::infinity(), Vec3::UnitZ()};
    for (const TangentPlane& face : faces) {
        const double distance = face.normal.dot(p) - face.offset;
        if (distance > largest.distance)
            largest = {distance, face.normal};
    }
    return largest.distance > 0 ? distance_to_hull(faces, p, largest) : largest;
}

/// Calls `f` with the distance function of the kind, so that loops are compiled once per kind and
/// branch outside.
template <class F>
decltype(auto) with_distance(ShapeKind kind, F&& f) {
    switch (kind) {
    case ShapeKind::sphere:
        return f(
            [](const RigidShape& s, const Vec3& p) noexcept { return sphere_distance(s.size, p); });
    case ShapeKind::box:
        return f(
            [](const RigidShape& s, const Vec3& p) noexcept { return box_distance(s.size, p); });
    case ShapeKind::capsule:
        return f([](const RigidShape& s, const Vec3& p) noexcept {
            return capsule_distance(s.size, p);
        });
    case ShapeKind::cylinder:
        return f([](const RigidShape& s, const Vec3& p) noexcept {
            return cylinder_distance(s.size, p);
        });
    case ShapeKind::convex:
        return f([](const RigidShape& s, const Vec3& p) noexcept {
            return convex_distance(s.faces, p);
        });
    case ShapeKind::plane:
    case ShapeKind::probed: // has none; never asked
        break;
    }
    return f([](const RigidShape& s, const Vec3& p) noexcept { return plane_distance(s.size, p); });
}

} // namespace ode::soft
