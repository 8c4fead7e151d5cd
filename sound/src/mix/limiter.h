#pragma once

#include <vector>

namespace ode::sound {

/// Keeps all channels of a stream below a ceiling, by one gain for all so that places don't move.
///
/// The gain that a peak needs is held over the look-ahead (a sliding minimum), let go
/// exponentially, and averaged over the look-ahead: it slides down before the peak arrives and is
/// never above what any sample needs. No sample exceeds the ceiling; quieter stretches pass bit for
/// bit, kLookAhead later.
class Limiter {
public:
    static constexpr double kLookAhead = 1.5e-3; ///< and delay [s]
    static constexpr double kRelease = 0.08;     ///< time constant [s]

    /// @param rate  [Hz].  @param ceiling  > 0, in the stream's unit.
    Limiter(double rate, int channels, double ceiling);

    int delay() const noexcept { return static_cast<int>(lacks_.size()); } ///< [frames]
    double ceiling() const noexcept { return ceiling_; }
    void set_ceiling(double ceiling) noexcept { ceiling_ = ceiling; }

    /// In place, interleaved.
    void run(float* frames, int count) noexcept;

    /// Least gain since the last call [-]; 1: nothing was held down.
    double take_least_gain() noexcept;

private:
    double needed(double gain) noexcept;

    int channels_;
    double ceiling_;
    double keep_; ///< of the gain's lack, a frame
    double released_ = 1.0;
    double least_ = 1.0;
    double sum_ = 0.0;           ///< of lacks_ (1 - gain): exact zero where all is quiet
    std::vector<double> held_;   ///< gains needed, the last delay() + 1 of them
    std::vector<double> lacks_;  ///< 1 - gain, the last delay() of them
    std::vector<float> waiting_; ///< frames
    std::size_t at_ = 0;
    std::size_t active_ = 0;         ///< frames until everything has passed
    std::vector<std::size_t> order_; ///< candidates of the minimum, oldest first, a ring
    std::size_t first_ = 0, count_ = 0;
    std::size_t frame_ = 0;
    std::vector<std::size_t> when_; ///< frame of each held gain
};

} // namespace ode::sound
