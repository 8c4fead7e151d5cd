#include "reduced/contact_view.h"

#include "reduced/mode_rows.h"

#include <algorithm>
#include <utility>

namespace ode::soft {

ContactView::ContactView(ModalMotion& motion, NodeState& nodes)
    : motion_(motion), nodes_(nodes), placed_(motion.basis().nodes(), 0),
      at_(motion.basis().nodes()), free_(motion.basis().nodes()),
      gain_(motion.basis().columns, 0.0f) {
    for (Length& length : lengths_) {
        length.rate.assign(motion.basis().columns, 0.0f);
        length.yield.resize(motion.basis().nodes());
        length.known.assign(motion.basis().nodes(), 0);
    }
    for (AlignedVector<float>& q : scratch_)
        q.assign(motion.basis().columns, 0.0f);
}

void ContactView::begin(std::span<const int> near, double dt) noexcept {
    const ModalBasis& b = motion_.basis();
    const double before = dt_;
    const bool moved = pushed_;
    dt_ = dt;
    const ModalState& now = motion_.state();
    const ModalState& ahead = motion_.foresee(dt);
    turn_ = now.turn.toRotationMatrix();
    const Mat3 turn = ahead.turn.toRotationMatrix();
    const Vec3 spin = motion_.spin();
    const Spread place(b, motion_.awake(now.amplitude), scratch_[0]),
        rate(b, motion_.awake(now.rate), scratch_[1]);
    const Spread later(b, motion_.awake(ahead.amplitude), scratch_[2]);
    for (const int node : near) {
        const auto n = static_cast<std::size_t>(node);
        const bool known = placed_[n] + 1 == substep_;
        const Vec3 last = at_[n];
        Vec3 here, there;
        if (known && !moved) {
            there = later.at(n);
            at_[n] = free_[n];
        } else {
            place.at(n, later, here, there);
            at_[n] = now.center + turn_ * (b.rest[n] + here);
        }
        const Vec3 x = at_[n];
        if (known)
            nodes_.velocity[n] = (x - last) / before;
        else if (placed_[n] != substep_)
            nodes_.velocity[n] = now.velocity + spin.cross(x - now.center) + turn_ * rate.at(n);
        nodes_.position[n] = x;
        free_[n] = ahead.center + turn * (b.rest[n] + there);
        placed_[n] = substep_;
    }
    pushed_ = false;
    impulse_.setZero();
    turning_.setZero();
    rigid_gain_.setZero();
    spin_gain_.setZero();
    if (moved)
        std::fill(gain_.begin(), gain_.end(), 0.0f);
    choose_length(dt);
    for (int axis = 0; axis < 3; ++axis)
        lightness_.col(axis) = motion_.spin_of(Vec3::Unit(axis));
}

void ContactView::choose_length(double dt) noexcept {
    const std::size_t band = motion_.band();
    const auto known = std::find_if(lengths_.begin(), lengths_.end(), [&](const Length& length) {
        return length.dt == dt && length.band == band;
    });
    if (known != lengths_.end()) {
        length_ = &*known;
        length_->used = substep_;
        return;
    }
    length_ = &*std::min_element(lengths_.begin(), lengths_.end(),
                                 [](const auto& a, const auto& b) { return a.used < b.used; });
    length_->dt = dt;
    length_->band = band;
    length_->used = substep_;
    std::fill(length_->known.begin(), length_->known.end(), std::uint8_t{0});
    const std::span<const double> drift = motion_.drift(dt);
    for (std::size_t k = 0; k < band; ++k)
        length_->rate[k] = static_cast<float>(drift[k]);
}

Vec3 ContactView::ahead(const CarriedPoint& point) const noexcept {
    const Spread gain(motion_.basis(), std::span(std::as_const(gain_)).first(motion_.band()));
    Vec3 out = Vec3::Zero(), local = Vec3::Zero(), at = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
        const double w = point.weight[static_cast<int>(i)];
        if (w == 0)
            continue;
        const auto n = static_cast<std::size_t>(point.node[i]);
        out += w / dt_ * (free_[n] - at_[n]);
        if (!pushed_)
            continue;
        local += w * gain.at(n);
        at += w * at_[n];
    }
    if (pushed_)
        out += rigid_gain_ + spin_gain_.cross(at - motion_.state().center) + turn_ * local;
    return out;
}

double ContactView::compliance(const CarriedPoint& point, const Vec3& direction) const noexcept {
    const ModalBasis& b = motion_.basis();
    const double modal = square(b, point, turn_.transpose() * direction, rates()) / dt_;
    if (b.held)
        return modal;
    Vec3 at = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
        if (const double w = point.weight[static_cast<int>(i)]; w != 0)
            at += w * at_[static_cast<std::size_t>(point.node[i])];
    const Vec3 arm = (at - motion_.state().center).cross(direction);
    return modal + 1 / b.total_mass + arm.dot(lightness_ * arm);
}

Vec3 ContactView::yield(std::size_t node, const Vec3& direction) const noexcept {
    const ModalBasis& b = motion_.basis();
    if (!length_->known[node]) {
        length_->yield[node] = squares(b, node, rates());
        length_->known[node] = 1;
    }
    const auto& [xx, yy, zz, xy, xz, yz] = length_->yield[node];
    const Vec3 n = turn_.transpose() * direction;
    const Vec3 local(xx * n.x() + xy * n.y() + xz * n.z(), xy * n.x() + yy * n.y() + yz * n.z(),
                     xz * n.x() + yz * n.y() + zz * n.z());
    const Vec3 modal = turn_ * local / dt_;
    if (b.held)
        return modal;
    const Vec3 arm = at_[node] - motion_.state().center;
    return modal + direction / b.total_mass + (lightness_ * arm.cross(direction)).cross(arm);
}

void ContactView::push(std::size_t node, const Vec3& force) noexcept {
    pushed_ = true;
    const ModalBasis& b = motion_.basis();
    // The mean rate over dt of a push of f dt is drift / dt times f dt.
    project(b, node, turn_.transpose() * force, rates(), std::span(gain_).first(motion_.band()));
    if (b.held)
        return;
    impulse_ += dt_ * force;
    turning_ += dt_ * (at_[node] - motion_.state().center).cross(force);
    rigid_gain_ = impulse_ / b.total_mass;
    spin_gain_ = lightness_ * turning_;
}

} // namespace ode::soft
