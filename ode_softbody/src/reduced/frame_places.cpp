#include "reduced/frame_places.h"

#include <cmath>

namespace ode::soft {

FramePlaces::FramePlaces(const ModalMotion& motion, const NodeGroups& groups, NodeState& nodes)
    : RoughPlaces(groups, motion.basis().rest), motion_(motion), nodes_(nodes),
      placed_(motion.basis().nodes(), 0) {
    for (AlignedVector<float>& q : scratch_)
        q.assign(motion.basis().columns, 0.0f);
}

void FramePlaces::begin(bool heard) noexcept {
    const ModalBasis& b = motion_.basis();
    const ModalState& now = motion_.state();
    const std::size_t columns = heard ? b.audible_columns : motion_.awake();
    ++look_;
    frame_ = {{now.center, now.turn.toRotationMatrix()}, now.velocity, motion_.spin()};
    moved_.emplace(b, std::span(now.amplitude).first(columns), scratch_[0]);
    rate_.emplace(b, std::span(now.rate).first(columns), scratch_[1]);
    const ModalMotion::Swing most = motion_.swing(scratch_[2], scratch_[3]);
    off_ = most.way;
    rush_ = most.speed;
    speed_ = std::sqrt(2 * motion_.vibration_energy() / b.total_mass);
    acceleration_ = motion_.frame_acceleration();
}

void FramePlaces::carry(int node) noexcept {
    const auto n = static_cast<std::size_t>(node);
    nodes_.position[n] = carried(node);
    nodes_.velocity[n] = frame_.velocity_at(nodes_.position[n]);
}

void FramePlaces::place(int node) noexcept {
    const ModalBasis& b = motion_.basis();
    const auto n = static_cast<std::size_t>(node);
    if (placed_[n] == look_)
        return;
    placed_[n] = look_;
    const Mat3& turn = frame_.pose.rotation;
    const Vec3 arm = turn * (b.rest[n] + moved_->at(n));
    nodes_.position[n] = frame_.pose.position + arm;
    nodes_.velocity[n] = frame_.velocity + frame_.spin.cross(arm) + turn * rate_->at(n);
}

RoughPlaces::Swing FramePlaces::swing(int node, const Vec3& direction) noexcept {
    const std::size_t awake = motion_.awake();
    const auto [way, acceleration] =
        reaches(motion_.basis(), static_cast<std::size_t>(node),
                frame_.pose.rotation.transpose() * direction, std::span(scratch_[2]).first(awake),
                std::span(scratch_[3]).first(awake));
    return {way, acceleration};
}

} // namespace ode::soft
