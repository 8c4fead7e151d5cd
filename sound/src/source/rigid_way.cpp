#include "source/rigid_way.h"

#include <algorithm>

namespace ode::sound {

// Trapezoidal rule on T^2/2 V'' + T V' + V = U. What is faster than a sample is taken to be as
// fast.
RigidWay::RigidWay(double time, double rate) noexcept : lapse_(1.0 / rate) {
    const double T = std::max(time, lapse_);
    const double inertia = T * T / (2.0 * lapse_), rest = T / 2.0 + lapse_ / 4.0;
    keep_ = (inertia - rest) / (inertia + rest);
    pass_ = 1.0 / (inertia + rest);
}

void RigidWay::start(double time, const Six& velocity) noexcept {
    begin_ = end_ = stepped_ = time;
    velocity_begin_ = velocity_end_ = velocity;
    pending_.setZero();
}

RigidWay::Six RigidWay::way_at(double time) const noexcept {
    const double length = end_ - begin_;
    const double u = length > 0.0 ? (time - begin_) / length : 0.0;
    // The velocity goes on a straight line: exact in flight.
    return length * (u * velocity_begin_ + 0.5 * u * u * (velocity_end_ - velocity_begin_));
}

void RigidWay::go_on(double time, const Six& velocity) noexcept {
    // What of the interval before lies beyond the last sample.
    pending_ += way_at(end_) - (stepped_ > begin_ ? way_at(stepped_) : Six(Six::Zero()));
    begin_ = end_;
    end_ = time;
    velocity_begin_ = velocity_end_;
    velocity_end_ = velocity;
}

void RigidWay::step_to(double time) noexcept {
    const Six from = stepped_ > begin_ ? way_at(stepped_) : Six(Six::Zero());
    const double lapse = time - stepped_;
    if (lapse > 0.0)
        mean_ = (pending_ + way_at(time) - from) / lapse;
    pending_.setZero();
    stepped_ = time;
}

void RigidWay::listen(double share) noexcept {
    const Six now = share * mean_;
    const Six before = slope_;
    slope_ = keep_ * before + pass_ * (0.5 * (heard_ + now) - velocity_);
    velocity_ += 0.5 * lapse_ * (before + slope_);
    heard_ = now;
}

} // namespace ode::sound
