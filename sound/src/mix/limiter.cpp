#include "mix/limiter.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

Limiter::Limiter(double rate, int channels, double ceiling)
    : channels_(channels), ceiling_(ceiling), keep_(std::exp(-1.0 / (kRelease * rate))) {
    const auto frames = static_cast<std::size_t>(std::ceil(kLookAhead * rate));
    held_.assign(frames + 1, 1.0); // a gain counts until its own frame leaves, that one included
    lacks_.assign(frames, 0.0);
    waiting_.assign(frames * static_cast<std::size_t>(channels), 0.0F);
    order_.assign(frames + 2, 0);
    when_.assign(frames + 1, 0);
}

/// The least gain needed within the look-ahead: candidates ascend from the oldest, which is the
/// least.
double Limiter::needed(double gain) noexcept {
    const std::size_t n = held_.size(), slots = order_.size();
    while (count_ > 0 && when_[order_[first_]] + n <= frame_) {
        first_ = (first_ + 1) % slots;
        --count_;
    }
    while (count_ > 0 && held_[order_[(first_ + count_ - 1) % slots]] >= gain)
        --count_;
    const std::size_t slot = frame_ % n;
    held_[slot] = gain;
    when_[slot] = frame_;
    order_[(first_ + count_) % slots] = slot;
    ++count_;
    return held_[order_[first_]];
}

void Limiter::run(float* frames, int count) noexcept {
    const auto channels = static_cast<std::size_t>(channels_);
    const auto n = static_cast<double>(lacks_.size());
    for (int f = 0; f < count; ++f, frames += channels) {
        double peak = 0.0;
        for (std::size_t c = 0; c < channels; ++c)
            peak = std::fmax(peak, std::abs(static_cast<double>(frames[c])));
        const double least = needed(peak > ceiling_ ? ceiling_ / peak : 1.0);
        const double recovered = 1.0 - keep_ * (1.0 - released_);
        released_ = std::min(least, recovered);
        if (1.0 - released_ < 1e-7) // a float cannot tell
            released_ = least;
        const double lack = 1.0 - released_;
        active_ = lack > 0.0 ? lacks_.size() : active_ - (active_ > 0);
        sum_ = active_ > 0 ? sum_ + lack - lacks_[at_] : 0.0;
        lacks_[at_] = lack;
        // Rounding must not lift the mean above what the oldest frame needs.
        const double gain = active_ > 0 ? std::min(1.0 - sum_ / n, 1.0) : 1.0;
        least_ = std::min(least_, gain);
        float* old = waiting_.data() + at_ * channels;
        for (std::size_t c = 0; c < channels; ++c) {
            double out = static_cast<double>(old[c]);
            if (active_ > 0)
                out *= gain;
            old[c] = frames[c];
            frames[c] = static_cast<float>(out);
        }
        at_ = at_ + 1 < lacks_.size() ? at_ + 1 : 0;
        ++frame_;
    }
}

double Limiter::take_least_gain() noexcept {
    const double least = least_;
    least_ = 1.0;
    return least;
}

} // namespace ode::sound
