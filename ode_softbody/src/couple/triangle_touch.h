#pragma once

#include "collide/closest_point.h"
#include "couple/contact_law.h"
#include "couple/hertz_spring.h"
#include "couple/node_forces.h"
#include "couple/rigid_response.h"
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
    EnergyBook book;
    bool is_point = false; ///< bears by `point`, with the elasticity known
    HertzSpring point;
};

/// Where a rigid shape touches a triangle of the soft surface.
struct TriangleTouch {
    int triangle;
    TrianglePoint at;
    double depth;             ///< [m]
    Vec3 slip;                ///< of the rigid against the soft side, half a substep ago [m/s]
    double damping = 0;       ///< [N s/m]
    double owed = 0;          ///< see EnergyBook [J]
    Press press = {};         ///< so far
    Vec3 grip = Vec3::Zero(); ///< friction on the rigid side [N]
};

/// What a substep's contacts act on. The soft side's forces hold everything else that acts.
struct TouchForces {
    std::span<const double> inverse_mass; ///< of every mesh node [1/kg]; 0: held
    const NodeArray& velocity;            ///< half a substep ago
    NodeForces force;
    double dt;
};

/// A point of the soft side over the substep to come.
struct Ahead {
    Vec3 velocity;     ///< mean, with all force so far [m/s]
    double compliance; ///< to a push along the direction asked for [1/kg]
};
[[gnu::always_inline]] inline Ahead ahead_of(const TouchForces& on, std::size_t node,
                                             const Vec3& direction) noexcept {
    if (const JointInertia* joint = on.force.joint()) {
        const CarriedPoint point{{static_cast<int>(node)}, {1, 0, 0}};
        return {joint->ahead(point), direction.dot(joint->yield(node, direction))};
    }
    const double lightness = on.inverse_mass[node];
    return {on.velocity[node] + on.dt * lightness * on.force[node], lightness};
}

/// Velocity of the rigid against the soft side at a touch [m/s].
Vec3 slip_at(const TriangleTouch& touch, const SurfaceNodes& surface, const NodeArray& velocity,
             const RigidMotion& motion) noexcept;

/// What the touch's friction asks of a light rigid body: see RigidShadow::soften().
double grip_load(const TriangleTouch& touch, const TouchState& state, double dt,
                 const RigidShadow& rigid) noexcept;

/// Opens the book of a touch that was found.
void open_book(TriangleTouch& touch, TouchState& state, double dt) noexcept;

/// Brings the normal force in line with all other force on both sides. The triangle's corners take
/// it by their weights at once, the rigid side is told of it.
void sweep_triangle(TriangleTouch& touch, const TouchState& state, const SurfaceNodes& surface,
                    const TouchForces& on, RigidResponse& rigid) noexcept;

/// Enters what the normal spring did in this substep, all forces being known.
void enter_book(const TriangleTouch& touch, TouchState& state, const SurfaceNodes& surface,
                const TouchForces& on, const RigidResponse& rigid) noexcept;

/// All that the rigid side gets of a touch, once friction is known [N].
inline Vec3 force_on_rigid(const TriangleTouch& touch, const TouchState& state) noexcept {
    return touch.press.force * state.normal + touch.grip;
}

/// Adds friction to both sides, opposite at one point.
/// @param softening  on its spring and dashpot, whose explicit step it keeps stable
/// @return whether the touch bears.
bool drag_triangle(TriangleTouch& touch, TouchState& state, double friction, double softening,
                   const SurfaceNodes& surface, const TouchForces& on, RigidShadow& rigid) noexcept;

} // namespace ode::soft
