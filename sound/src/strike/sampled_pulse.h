#pragma once

#include <array>
#include <cstdint>

namespace ode::sound {

/// The force of a blow (pulse_share()) as a row of samples, whose sum is 1. Times are in samples.
///
/// A short one is smoothed over three samples, by the quadratic B-spline, so that what it holds
/// above half the rate is folded down as little as may be: by sinc(w/2)^3 at w [rad a sample],
/// images by as much at theirs. One of many samples is taken as it goes.
class SampledPulse {
public:
    /// Whether what the smoothing takes away is given back (within 0.14 dB up to 5/12 of the rate),
    /// and what a hold of one sample takes beside. Else the reader does: smoothing().
    enum class Window { kSmooth, kFlat };

    static constexpr double kShort = 16.0; ///< longer pulses are not smoothed

    /// @param begin     first sample is 0 of all time.  @param duration  above 0.
    void aim(double begin, double duration, Window window) noexcept;

    std::int64_t first() const noexcept { return first_; } ///< that is not 0
    std::int64_t end() const noexcept { return end_; }     ///< from there on all are 0
    bool is_short() const noexcept { return duration_ <= kShort; }
    double middle() const noexcept { return begin_ + 0.5 * duration_; }
    double duration() const noexcept { return duration_; }

    void read(std::int64_t from, int samples, float* out) const noexcept;
    double rest(std::int64_t from) const noexcept; ///< sum of those from there on
    /// What lies before a sample comes at once there.
    void hurry(std::int64_t earliest) noexcept;

    /// sinc(w/2)^3: what is left of w [rad a sample] in a short one.
    static double smoothing(double w) noexcept;

private:
    static constexpr int kMost = 32; ///< samples of a short one

    double begin_ = 0.0, duration_ = 1.0;
    std::int64_t first_ = 0, end_ = 0;
    float late_ = 0.0f; ///< beside its own, of the first sample of a long one
    alignas(64) std::array<float, kMost> short_{};
};

} // namespace ode::sound
