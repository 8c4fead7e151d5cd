#include "reduced/frame_places.h"

#include <cmath>

namespace ode::soft {

FramePlaces::FramePlaces(const ModalMotion& motion, NodeState& nodes)
    : motion_(motion), nodes_(nodes) {
    for (AlignedVector<float>& q : scratch_)
        q.assign(motion.basis().columns, 0.0f);
}

void FramePlaces::begin() noexcept {
    const ModalBasis& b = motion_.basis();
    const ModalState& now = motion_.state();
    turn_ = now.turn.toRotationMatrix();
    spin_ = motion_.spin();
    moved_.emplace(b, std::span(now.amplitude).first(b.audible_columns), scratch_[0]);
    rate_.emplace(b, std::span(now.rate).first(b.audible_columns), scratch_[1]);
    off_ = motion_.largest_displacement();
    speed_ = std::sqrt(2 * motion_.vibration_energy() / b.total_mass);
}

void FramePlaces::carry(int node) noexcept {
    const auto n = static_cast<std::size_t>(node);
    const Vec3 arm = turn_ * motion_.basis().rest[n];
    nodes_.position[n] = motion_.state().center + arm;
    nodes_.velocity[n] = motion_.state().velocity + spin_.cross(arm);
}

void FramePlaces::place(int node) noexcept {
    const ModalBasis& b = motion_.basis();
    const auto n = static_cast<std::size_t>(node);
    const Vec3 arm = turn_ * (b.rest[n] + moved_->at(n));
    nodes_.position[n] = motion_.state().center + arm;
    nodes_.velocity[n] = motion_.state().velocity + spin_.cross(arm) + turn_ * rate_->at(n);
}

} // namespace ode::soft
