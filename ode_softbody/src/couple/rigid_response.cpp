#include "couple/rigid_response.h"

#include <Eigen/LU>

#include <cmath>

namespace ode::soft {

void RigidResponse::begin(const RigidShadow& rigid, double dt) noexcept {
    dt_ = dt;
    center_ = rigid.motion().pose.position;
    moves_ = rigid.can_move();
    free_ = rigid.twist_ahead(dt);
    twist_ = free_;
    if (!moves_)
        return;
    mobility_ = rigid.mobility();
    // As much as in the last substep is a good guess.
    twist_ = free_ + dt * (mobility_ * applied_);
    applied_.setZero();
}

void RigidResponse::open(const RigidShadow& rigid) noexcept {
    change_ = 0;
    sum_ = 0;
    wrench_.setZero();
    if (!moves_)
        return;
    stiffness_.setZero();
    const Vec6 free = rigid.twist_ahead(dt_) - dt_ * (mobility_ * applied_);
    twist_ += free - free_;
    free_ = free;
}

void RigidResponse::add(const Vec3& world, const Vec3& along, const Press& press,
                        double before) noexcept {
    change_ += std::fabs(press.force - before);
    sum_ += press.force;
    if (press.force == 0)
        return;
    Vec6 push;
    push << along, (world - center_).cross(along);
    wrench_ += press.force * push;
    if (moves_)
        stiffness_.noalias() += (press.slope * push) * push.transpose();
}

void RigidResponse::close(RigidShadow& rigid) noexcept {
    const Vec6 more = wrench_ - applied_;
    applied_ = wrench_;
    if (change_ == 0)
        return;
    rigid.add({more.head<3>(), more.tail<3>()});
    if (!moves_)
        return;
    const Vec6 miss = free_ + dt_ * (mobility_ * wrench_) - twist_;
    const Mat6 slope = Mat6::Identity() + dt_ * dt_ * (mobility_ * stiffness_);
    twist_ += slope.partialPivLu().solve(miss);
}

} // namespace ode::soft
