#pragma once

#include "dsp/storage.h"

namespace ode::sound {

/// Smooths the flow of a surface where its motion breaks off or sets in: a body that ends, falls
/// asleep, or is first seen in flight.
///
/// At a break the flow jumps by some value. Adding that jump back, decaying, makes the sum
/// continuous, and what follows keeps its own shape: an attack after waking is not blunted. Sound
/// is the flow's derivative, so at an end the slope decays as well, the faster since it would
/// thump.
class FlowFade {
public:
    static constexpr double kValueTime = 5e-3; ///< [s], half a cosine
    static constexpr double kSlopeTime = 5e-4; ///< [s], cubic

    explicit FlowFade(int nodes) : value_(static_cast<std::size_t>(nodes)), slope_(value_.size()) {}

    double* value() noexcept { return value_.data(); } ///< [m^3/s], to be set before begin()
    double* slope() noexcept { return slope_.data(); } ///< [m^3/s^2]
    void begin(double time) noexcept;
    bool is_active(double time) const noexcept { return !zero_ && time < begin_ + kValueTime; }
    void stop() noexcept { zero_ = true; }

    /// Adds the decaying flow to the volumes [m^3] of an interval [s].
    void add(double begin, double end, double* volume) const noexcept;

private:
    double begin_ = 0.0;
    bool zero_ = true;
    AlignedVector value_;
    AlignedVector slope_;
};

} // namespace ode::sound
