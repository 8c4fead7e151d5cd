#include "couple/rigid_bond.h"

#include <Eigen/LU>

namespace ode::soft {
namespace {

Mat3 cross_matrix(const Vec3& r) noexcept {
    Mat3 m;
    m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    return m;
}

} // namespace

void RigidBond::begin(const RigidShadow& rigid, double dt) noexcept {
    dt_ = dt;
    center_ = rigid.motion().pose.position;
    inertia_.setZero();
    momentum_.setZero();
}

void RigidBond::add(double mass, const Vec3& position, const Vec3& velocity,
                    const Vec3& force) noexcept {
    const Vec3 r = position - center_;
    const Mat3 cross = cross_matrix(r);
    inertia_.topLeftCorner<3, 3>().diagonal().array() += mass;
    inertia_.topRightCorner<3, 3>() -= mass * cross;
    inertia_.bottomLeftCorner<3, 3>() += mass * cross;
    inertia_.bottomRightCorner<3, 3>() -= mass * cross * cross;
    const Vec3 p = mass * velocity + dt_ * force;
    momentum_.head<3>() += p;
    momentum_.tail<3>() += r.cross(p);
}

/// The body's twist after the kick, as far as it is known, from the velocities of three points.
RigidBond::Vec6 RigidBond::twist_ahead(const RigidShadow& rigid) const noexcept {
    const Vec3 v = rigid.velocity_ahead(center_, dt_);
    const Vec3 x = rigid.velocity_ahead(center_ + Vec3::UnitX(), dt_) - v; // w cross x
    const Vec3 y = rigid.velocity_ahead(center_ + Vec3::UnitY(), dt_) - v;
    Vec6 twist;
    twist << v, y.z(), -x.z(), x.y();
    return twist;
}

void RigidBond::bind(RigidShadow& rigid) noexcept {
    rigid.add({Vec3::Zero(), owed_ / dt_});
    owed_.setZero();
    const Vec6 free = twist_ahead(rigid);
    Mat6 answer; // to a unit wrench over the substep, per second
    for (int k = 0; k < 6; ++k) {
        Wrench unit;
        (k < 3 ? unit.force : unit.torque)[k % 3] = 1;
        RigidShadow tried = rigid;
        tried.add(unit);
        answer.col(k) = (twist_ahead(tried) - free) / dt_;
    }
    const Vec6 twist =
        (Mat6::Identity() + answer * inertia_).partialPivLu().solve(free + answer * momentum_);
    linear_ = twist.head<3>();
    spin_ = twist.tail<3>();
    const Vec6 wrench = (momentum_ - inertia_ * twist) / dt_;
    rigid.add({wrench.head<3>(), wrench.tail<3>()});
}

} // namespace ode::soft
