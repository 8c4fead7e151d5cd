#pragma once

#include "base/types.h"

#include <ode/collision.h>

#include <span>
#include <vector>

namespace ode::soft {

/// A piece of a rigid surface seen as a plane, in the shape's frame: solid where normal.x < offset.
struct TangentPlane {
    Vec3 normal;
    double offset; ///< [m]
};

/// Corners of a convex geom, in its own frame [m]. ODE has no getter, but its contacts of a convex
/// with a plane are the corners below the plane: two planes back to back show all. Of its other
/// colliders, balls end the program where they just touch (libccd's zero direction) and rays report
/// wrong depths for turned geoms (0.16).
std::vector<Vec3> convex_corners(dGeomID convex);

/// Face planes of the hull of some points: those through three points that have none outside.
/// O(n^4) at worst, once a contact: a millisecond for 30 corners.
std::vector<TangentPlane> hull_faces(std::span<const Vec3> corners);

/// A trimesh that bounds a convex solid.
struct ConvexMesh {
    std::vector<Vec3> corner; ///< in the geom's own frame [m]
    std::vector<TangentPlane> face;
};

/// Many trimeshes are closed and convex, and better served as such: their distance is exact, where
/// planes felt round a node (SurfaceProbe) know no end.
/// @return nothing where the mesh isn't: open, hollow somewhere, or of more than 64 planes.
ConvexMesh convex_mesh(dGeomID trimesh);

} // namespace ode::soft
