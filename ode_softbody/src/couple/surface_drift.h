#pragma once

#include "couple/soft_surface.h"

#include <limits>

namespace ode::soft {

/// Fastest that points of two surfaces can be moving against each other [m/s]: each against the
/// mean velocity of all.
double fastest_between(const SurfaceNodes& a, const NodeArray& velocity_a, const SurfaceNodes& b,
                       const NodeArray& velocity_b) noexcept;

/// How a surface has changed its shape, apart from moving as a rigid whole.
struct Deformation {
    double displacement; ///< of a node, at most [m]
    double speed;        ///< of a node, at most [m/s]
};

/// Against the rigid motion that fits best in the mean square, all nodes weighing the same.
Deformation deformation_of(const SoftSurface& surface, const NodeArray& position,
                           const NodeArray& velocity) noexcept;

} // namespace ode::soft
