#pragma once

#include "collide/rigid_shape.h"

#include <vector>

namespace ode::soft {

/// A ball fixed to a rigid shape, inside it and touching its surface.
struct RigidSample {
    Vec3 center;       ///< in the shape's frame [m]
    double radius = 0; ///< [m]
};

/// Balls by which a shape feels the soft surface between its nodes: the sphere itself, balls along
/// a capsule, points on corners and edges of boxes and convex shapes, and on a cylinder's rims.
/// A plane needs none: nothing of it passes between nodes that all lie above.
/// @param spacing  wanted distance of points [m]; large shapes get larger ones.
std::vector<RigidSample> sample_shape(const RigidShape& shape, double spacing);

} // namespace ode::soft
