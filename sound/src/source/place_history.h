#pragma once

#include "dsp/storage.h"
#include "source/surface.h"

#include <cstdint>

namespace ode::sound {

/// Where the nodes were at the last samples of the grid, and where they were before a jump.
class PlaceHistory {
public:
    /// @param samples  kept.
    PlaceHistory(int nodes, int samples);

    int capacity() const noexcept { return samples_; }

    void reserve(int samples); ///< keeps what is there; allocates

    double* at(std::int64_t sample) noexcept; ///< points [m]

    /// First and last sample stored are the caller's to keep in step.
    std::int64_t newest() const noexcept { return newest_; }
    void set_newest(std::int64_t sample) noexcept { newest_ = sample; }

    /// The surface leaves the place `from` at a sample and is elsewhere after: a teleport. Sound
    /// crosses over from the old place to the new one, since a wave train cut off clicks.
    void jump(const double* from, std::int64_t sample, int duration) noexcept;
    const double* ghost() const noexcept { return ghost_.data(); }
    /// Part of the sound that still comes from the ghost: 1 to 0.
    double ghost_share(std::int64_t sample) const noexcept;

private:
    std::size_t length_; ///< doubles per sample
    int samples_;
    std::int64_t newest_ = 0;
    std::int64_t jump_ = 0;
    int duration_ = 0;
    AlignedVector place_;
    AlignedVector ghost_;
};

} // namespace ode::sound
