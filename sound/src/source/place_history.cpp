#include "source/place_history.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {

PlaceHistory::PlaceHistory(int nodes, int samples)
    : length_(4 * static_cast<std::size_t>(nodes)), samples_(samples),
      place_(length_ * static_cast<std::size_t>(samples)), ghost_(length_) {}

void PlaceHistory::reserve(int samples) {
    if (samples <= samples_)
        return;
    PlaceHistory larger(static_cast<int>(length_ / 4), samples);
    for (std::int64_t o = newest_ - samples_ + 1; o <= newest_; ++o)
        std::copy_n(at(o), length_, larger.at(o));
    std::swap(larger.place_, place_);
    samples_ = samples;
}

double* PlaceHistory::at(std::int64_t sample) noexcept {
    const std::int64_t slot = ((sample % samples_) + samples_) % samples_;
    return place_.data() + static_cast<std::size_t>(slot) * length_;
}

void PlaceHistory::jump(const double* from, std::int64_t sample, int duration) noexcept {
    std::copy_n(from, length_, ghost_.begin());
    jump_ = sample;
    duration_ = duration;
}

double PlaceHistory::ghost_share(std::int64_t sample) const noexcept {
    if (sample < jump_ || sample >= jump_ + duration_)
        return 0.0;
    const double u = static_cast<double>(sample - jump_) / duration_;
    return 0.5 * (1.0 + std::cos(std::numbers::pi * u));
}

} // namespace ode::sound
