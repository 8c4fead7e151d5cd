#pragma once

#include "couple/contact_law.h"
#include "couple/rigid_shadow.h"

namespace ode::soft {

/// How a rigid body answers all normal forces of a substep together.
///
/// Each force F_j = F_j(d_j) hangs on the depth d_j that its contact would reach without it, and
/// this on the body's twist u after the kick, which all the forces make:
///     u = u_free + dt A sum of J_j F_j(c_j - dt J_j.u),   J_j = (n_j, r_j x n_j)
/// with the body's answer A to a wrench. The forces grow with depth, so that this has one solution,
/// whatever the body's mass, and Newton's method, on six unknowns, finds it in a few sweeps over
/// the contacts. Solved, each spring's work is what its potential loses: nothing is gained however
/// light the body is beside the springs. Contacts that hear of each other in turn, once, threw a
/// thin plate under a box with four times the energy of its fall.
///
/// Per substep: begin(); per sweep open(), each contact's add(), close(). What else acts on the
/// body may change between sweeps.
class RigidResponse {
public:
    void begin(const RigidShadow& rigid, double dt) noexcept;
    bool moves() const noexcept { return moves_; } ///< else one sweep is enough

    void open(const RigidShadow& rigid) noexcept;
    /// Velocity after the kick, as far as it is known, of a point of the body [m/s].
    Vec3 velocity_at(const Vec3& world) const noexcept {
        return twist_.head<3>() + twist_.tail<3>().cross(world - center_);
    }
    /// @param along   unit, the direction in which the force moves the body.
    /// @param before  the same contact's in the sweep before [N].
    void add(const Vec3& world, const Vec3& along, const Press& press, double before) noexcept;
    /// Gives the body the new forces in place of the last sweep's.
    void close(RigidShadow& rigid) noexcept;

    /// All forces are known: velocity_at() becomes what will be.
    void end(const RigidShadow& rigid) noexcept { twist_ = rigid.twist_ahead(dt_); }

    /// Of the forces in the last sweep, of their sum.
    double change() const noexcept { return sum_ > 0 ? change_ / sum_ : 0; }

    bool wanted = false; ///< for its owner's use: some contact touches in this substep

private:
    double dt_ = 0;
    bool moves_ = false;
    Vec3 center_ = Vec3::Zero();
    Mat6 mobility_ = Mat6::Zero();
    Vec6 twist_ = Vec6::Zero(); ///< u, on trial
    Vec6 free_ = Vec6::Zero();
    Vec6 applied_ = Vec6::Zero(); ///< wrench of the last sweep
    Vec6 wrench_ = Vec6::Zero();
    Mat6 stiffness_ = Mat6::Zero();
    double change_ = 0;
    double sum_ = 0;
};

/// Sweeps until the forces settle: what is left of a change is work that no potential knows of.
/// @param sweep  one sweep over all contacts; returns the largest change().
template <class Sweep>
void settle(Sweep sweep) {
    constexpr int kMostSweeps = 8;
    constexpr double kSettled = 1e-3;
    for (int i = 0; i < kMostSweeps; ++i)
        if (sweep() < kSettled)
            return;
}

} // namespace ode::soft
