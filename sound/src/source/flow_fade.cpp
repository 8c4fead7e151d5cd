#include "source/flow_fade.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {

void FlowFade::begin(double time) noexcept {
    begin_ = time;
    const auto is_zero = [](double v) { return v == 0.0; };
    zero_ = std::all_of(value_.begin(), value_.end(), is_zero) &&
            std::all_of(slope_.begin(), slope_.end(), is_zero);
}

void FlowFade::add(double begin, double end, double* volume) const noexcept {
    const double since = 0.5 * (begin + end) - begin_;
    const double u = std::clamp(since / kValueTime, 0.0, 1.0);
    const double s = std::clamp(since / kSlopeTime, 0.0, 1.0);
    const double duration = end - begin;
    const double of_value = duration * 0.5 * (1.0 + std::cos(std::numbers::pi * u));
    const double of_slope = duration * kSlopeTime * s * (1.0 - s) * (1.0 - s);
    for (std::size_t i = 0; i < value_.size(); ++i)
        volume[i] += of_value * value_[i] + of_slope * slope_[i];
}

} // namespace ode::sound
