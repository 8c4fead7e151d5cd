#pragma once

#include "couple/rigid_shadow.h"

#include <Eigen/Core>

namespace ode::soft {

/// Point masses nailed to one rigid body, exactly: within a substep they have the velocity of its
/// points, and it moves with their inertia and under their forces.
///
/// With u the twist (v, w) of the body about its centre x after the kick, r_i = x_i - x the levers
/// and B_i = (1, -[r_i]): node i has v_i' = B_i u, so what holds it is l_i = m_i (B_i u - v_i)/dt -
/// f_i and the body gets the wrench W = -sum B_i^T l_i. The body's own answer is linear, u = u_free
/// + A W, hence (1 + A M / dt) u = u_free + A p / dt with M = sum m_i B_i^T B_i and p = sum B_i^T
/// (m_i v_i + dt f_i). Momentum goes from one to the other to rounding; a constraint only lowers
/// frequencies, so no mass ratio shortens the substep.
///
/// A node turns on a circle where its velocity points along the chord: (W dt)^2 / 2 of its angular
/// momentum would be lost in each substep. It is given to the body in the next one.
///
/// Per substep: add() all nodes, bind(), the body's advance(); then velocity() and, once the node
/// has its new place, settle().
class RigidBond {
public:
    /// A new substep. @param dt [s]
    void begin(const RigidShadow& rigid, double dt) noexcept;
    /// @param force  all that acts on the node but the bond [N].
    void add(double mass, const Vec3& position, const Vec3& velocity, const Vec3& force) noexcept;
    /// Hands the reaction to the body. Not for forces of a later moment: contacts come before.
    void bind(RigidShadow& rigid) noexcept;

    /// Of a node that was at `position` before the substep.
    Vec3 velocity(const Vec3& position) const noexcept {
        return linear_ + spin_.cross(position - center_);
    }
    /// @param velocity  as above. @param from, to  before and after the substep.
    void settle(double mass, const Vec3& velocity, const Vec3& from, const Vec3& to) noexcept {
        owed_ += mass * (from - to).cross(velocity);
    }
    /// A new step, or the same once more: nothing is owed.
    void forget() noexcept { owed_.setZero(); }

private:
    using Vec6 = Eigen::Matrix<double, 6, 1>;
    using Mat6 = Eigen::Matrix<double, 6, 6>;

    Vec6 twist_ahead(const RigidShadow& rigid) const noexcept;

    double dt_ = 0;
    Vec3 center_ = Vec3::Zero();
    Mat6 inertia_ = Mat6::Zero();
    Vec6 momentum_ = Vec6::Zero(); ///< p
    Vec3 linear_ = Vec3::Zero();
    Vec3 spin_ = Vec3::Zero();
    Vec3 owed_ = Vec3::Zero(); ///< [kg m^2/s]
};

} // namespace ode::soft
