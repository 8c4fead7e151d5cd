#pragma once

#include "collide/closest_point.h"
#include "couple/contact_law.h"
#include "couple/hertz_spring.h"
#include "couple/node_forces.h"
#include "couple/rigid_shadow.h"
#include "couple/surface_nodes.h"

#include <span>

namespace ode::soft {

/// What a contact between a rigid shape and a point of the soft surface remembers from substep to
/// substep.
struct TouchState {
    bool bears = false;
    Vec3 normal = Vec3::Zero();  ///< of the soft surface, outward, world
    Vec3 stretch = Vec3::Zero(); ///< of the friction spring, world [m]
    double stiffness = 0;        ///< [N/m]
    Overlap overlap;
    bool is_point = false; ///< bears by `point`, with the elasticity known
    HertzSpring point;
};

/// Where a rigid shape touches a triangle of the soft surface.
struct TriangleTouch {
    int triangle;
    TrianglePoint at;
    double depth; ///< [m]
};

/// Velocity of the rigid against the soft side at a touch [m/s].
Vec3 slip_at(const TriangleTouch& touch, const SurfaceNodes& surface, const NodeArray& velocity,
             const RigidMotion& motion) noexcept;

/// What the contact asks of a light rigid body's stability: see RigidShadow::soften().
/// @param damping  of the dashpots [N s/m]
double load_of(const TriangleTouch& touch, const TouchState& state, double damping, double dt,
               const RigidShadow& rigid) noexcept;

/// Adds the contact's force to both sides, opposite at one point: the triangle's corners take it by
/// their weights.
/// @param softening  on friction's spring and the dashpots, whose explicit step it keeps stable;
/// the
///                   normal spring is stable by itself
/// @return whether it bore any.
bool push_triangle(const TriangleTouch& touch, TouchState& state, const ContactLaw& law,
                   double damping, double softening, const SurfaceNodes& surface,
                   const NodeArray& velocity, std::span<const double> inverse_mass, double dt,
                   RigidShadow& rigid, const NodeForces& force) noexcept;

} // namespace ode::soft
