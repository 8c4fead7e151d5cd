#pragma once

#include <cstdint>

namespace ode::sound {

/// What travels to one ear, from being sent to being read. One audio frame is one sample of it.
class Line {
public:
    virtual ~Line() = default;

    /// The next frames, in order. All waves that reach them must have been sent.
    virtual void read(int frames, double* out) noexcept = 0;

    /// First frame after which nothing is under way.
    virtual std::int64_t last_frame() const noexcept = 0;
};

/// Longest way that a line keeps [s of sound]; waves further away are lost.
constexpr double kLongestDelay = 2.5;

} // namespace ode::sound
