#include "path/paper_line.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace ode::sound {

PaperLine::PaperLine(double rate, std::int64_t frame, double gain, bool differentiate)
    : ring_(std::bit_ceil(static_cast<std::size_t>(std::ceil(rate * kLongestDelay))), 0.0),
      mask_(static_cast<std::int64_t>(ring_.size()) - 1), next_(frame), latest_(frame),
      gain_(differentiate ? gain * rate : gain), differentiate_(differentiate) {}

void PaperLine::add(std::int64_t sample, double delay, double value) noexcept {
    const auto most = static_cast<double>(mask_ - kAfter);
    if (!(delay >= 0.0 && delay < most) || !std::isfinite(value))
        return;
    const auto whole = static_cast<std::int64_t>(delay);
    const double fraction = delay - static_cast<double>(whole);
    const std::int64_t base = sample + whole;
    if (base - kBefore < next_ || base + kAfter >= next_ + mask_)
        return;
    static const double kPeak = 1.0 / (kSigma * std::sqrt(2.0 * std::numbers::pi));
    for (int k = -kBefore; k <= kAfter; ++k) {
        const double x = (k - fraction) / kSigma;
        ring_[static_cast<std::size_t>((base + k) & mask_)] +=
            value * kPeak * std::exp(-0.5 * x * x);
    }
    latest_ = std::max(latest_, base + kAfter + 1);
}

void PaperLine::read(int frames, double* out) noexcept {
    for (int f = 0; f < frames; ++f, ++next_) {
        double& cell = ring_[static_cast<std::size_t>(next_ & mask_)];
        out[f] = gain_ * (differentiate_ ? cell - before_ : cell);
        before_ = cell;
        cell = 0.0;
    }
}

} // namespace ode::sound
