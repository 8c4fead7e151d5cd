#pragma once

#include <cmath>
#include <cstdint>

namespace ode::sound {

/// Peak and root mean square of all that passes.
class Meter {
public:
    void add(double sample) noexcept {
        peak_ = std::fmax(peak_, std::abs(sample));
        sum_ += sample * sample;
        ++count_;
    }
    void add(const Meter& other) noexcept {
        peak_ = std::fmax(peak_, other.peak_);
        sum_ += other.sum_;
        count_ += other.count_;
    }
    double peak() const noexcept { return peak_; }
    double rms() const noexcept {
        return count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_)) : 0.0;
    }

private:
    double peak_ = 0.0;
    double sum_ = 0.0;
    std::uint64_t count_ = 0;
};

} // namespace ode::sound
