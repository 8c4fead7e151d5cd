#include "listen/ear_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {

EarPath::EarPath(double rate, const Vec3& position)
    : rate_(rate), keep_(std::exp(-1.0 / (kSmoothing * rate))), position_(position),
      target_(position), ghost_(position),
      state_(static_cast<std::size_t>(kKept)), rest_{position, Vec3::Zero(), position, 0.0} {}

void EarPath::move_to(const Vec3& target, std::int64_t begin, int samples) {
    if (still_) {
        if (target == position_)
            return;
        last_ = begin;
        std::fill(state_.begin(), state_.end(), rest_);
        still_ = false;
    } else {
        at(begin);
    }
    target_ = target;
    left_ = std::max(samples, 1);
    if ((target_ - position_).norm() * rate_ > kJump * static_cast<double>(left_)) {
        fade_length_ = std::max(left_, static_cast<std::int64_t>(kCrossOver * rate_));
        fading_ = fade_length_;
        ghost_ = position_;
        position_ = target_;
        velocity_.setZero();
        left_ = 0;
        return;
    }
    pace_ = (target_ - position_) / static_cast<double>(left_);
}

const EarPath::State& EarPath::at(std::int64_t sample) {
    if (still_)
        return rest_;
    while (last_ < sample && !still_) {
        ++last_;
        state_[static_cast<std::size_t>(last_ & (kKept - 1))] = step();
    }
    if (still_)
        return rest_;
    const std::int64_t kept = std::max(sample, last_ - kKept + 1);
    return state_[static_cast<std::size_t>(kept & (kKept - 1))];
}

EarPath::State EarPath::step() noexcept {
    constexpr double kNegligible = 1e-4; // [m/s]: 0.3 ppm of pitch
    Vec3 pace = Vec3::Zero();
    if (left_ > 0) {
        pace = pace_;
        position_ = --left_ > 0 ? Vec3(position_ + pace_) : target_;
    }
    velocity_ = keep_ * velocity_ + (1.0 - keep_) * rate_ * pace;
    double share = 0.0;
    if (fading_ > 0) {
        const double u = static_cast<double>(fading_--) / static_cast<double>(fade_length_);
        share = 0.5 - 0.5 * std::cos(std::numbers::pi * u);
    }
    if (left_ == 0 && fading_ == 0 && velocity_.norm() < kNegligible) {
        velocity_.setZero();
        rest_ = {position_, velocity_, position_, 0.0};
        still_ = true;
    }
    return {position_, velocity_, ghost_, share};
}

} // namespace ode::sound
