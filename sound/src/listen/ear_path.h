#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace ode::sound {

using Vec3 = Eigen::Vector3d;

/// Where an ear is at every sample of a grid.
///
/// The app moves ears in steps of its own; an ear goes there in a straight line over the time of
/// one step. Waves are aimed at where an ear will be when they arrive, for which its velocity is
/// needed; that is smoothed (kSmoothing), since a velocity that jumps would make arrivals jump.
/// Constant velocities are exact; in between Doppler shift lags by the smoothing time. A move that
/// no ear makes (a cut of the camera) is a jump: what is heard crosses over from the old place to
/// the new.
class EarPath {
public:
    static constexpr double kSmoothing = 0.05; ///< [s]

    static constexpr double kJump = 100.0;     ///< faster moves cross over instead [m/s]
    static constexpr double kCrossOver = 5e-3; ///< or longer, if the step is [s]

    struct State {
        Vec3 position;      ///< [m]
        Vec3 velocity;      ///< smoothed [m/s]
        Vec3 ghost;         ///< where the ear was before it jumped [m]
        double ghost_share; ///< of what it hears that is still heard there, 1 to 0
    };

    /// @param rate  of the grid [Hz].
    EarPath(double rate, const Vec3& position);

    /// From grid sample `begin` on, moves to `target` in `samples` samples.
    void move_to(const Vec3& target, std::int64_t begin, int samples);

    /// State at a grid sample. Later samples may be asked for at any time, earlier ones as far back
    /// as kKept.
    const State& at(std::int64_t sample);

    /// True while standing still: one State serves for all samples.
    bool is_still() const noexcept { return still_; }

private:
    static constexpr std::int64_t kKept = 4096;

    State step() noexcept;

    double rate_;
    double keep_; ///< of the smoothed velocity, a sample
    bool still_ = true;
    std::int64_t last_ = 0; ///< newest sample worked out
    Vec3 position_;         ///< there
    Vec3 velocity_ = Vec3::Zero();
    Vec3 pace_ = Vec3::Zero(); ///< [m a sample]
    Vec3 target_;
    std::int64_t left_ = 0; ///< samples until target
    Vec3 ghost_;
    std::int64_t fading_ = 0; ///< samples that the ghost still has
    std::int64_t fade_length_ = 1;
    std::vector<State> state_;
    State rest_;
};

} // namespace ode::sound
