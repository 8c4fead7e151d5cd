#include "dsp/step_kernel.h"

#include "dsp/kaiser.h"

namespace ode::sound {
namespace {

constexpr double kAttenuation = 101.0; // what 13 samples and a transition of 0.5 allow

double impulse(double x) {
    return sinc(x) * kaiser(x / StepKernel::kHalfWidth, kaiser_beta(kAttenuation));
}

} // namespace

StepKernel::StepKernel() {
    constexpr int kCount = static_cast<int>(2.0 * kHalfWidth) * kPerSample + 1;
    constexpr double kPitch = 1.0 / kPerSample;
    value_.assign(kCount, 0.0);
    slope_.assign(kCount, 0.0);
    for (int i = 0; i < kCount; ++i) {
        const double x = -kHalfWidth + i * kPitch;
        slope_[static_cast<std::size_t>(i)] = impulse(x) * kPitch;
        if (i == 0)
            continue;
        // Simpson over one pitch: error (pi / 64)^5 / 2880, below 1e-10.
        const double area =
            (impulse(x - kPitch) + 4.0 * impulse(x - 0.5 * kPitch) + impulse(x)) / 6.0;
        value_[static_cast<std::size_t>(i)] =
            value_[static_cast<std::size_t>(i - 1)] + area * kPitch;
    }
    const double total = value_.back();
    for (double& value : value_)
        value /= total;
    for (double& slope : slope_)
        slope /= total;
}

double StepKernel::operator()(double x) const noexcept {
    if (!(x > -kHalfWidth))
        return 0.0;
    if (x >= kHalfWidth)
        return 1.0;
    const double place = (x + kHalfWidth) * kPerSample;
    const auto i = static_cast<std::size_t>(place);
    const double u = place - static_cast<double>(i);
    if (i + 1 >= value_.size())
        return 1.0;
    const double rise = value_[i + 1] - value_[i];
    const double a = slope_[i] - rise;
    const double b = rise - slope_[i + 1];
    return value_[i] + u * (rise + (1.0 - u) * (a * (1.0 - u) + b * u));
}

const StepKernel& step_kernel() {
    static const StepKernel table;
    return table;
}

} // namespace ode::sound
