#pragma once

#include "dsp/storage.h"

#include <cstddef>
#include <span>

namespace ode::sound {

/// Damped vibrations that ring freely, q'' + 2 d q' + w^2 q = 0, at any time and at the samples of
/// a grid.
class Resonators {
public:
    /// @param omega  undamped, > 0 [rad/s].  @param decay  [1/s], below omega, or they stand still.
    /// @param rate   of the grid [Hz].
    Resonators(std::span<const double> omega, std::span<const double> decay, double rate);

    std::size_t size() const noexcept { return omega_.size(); }

    /// Carries the first `count` amplitudes and rates over a time, which may be negative [s].
    void evolve(double time, std::size_t count, double* amplitude, double* rate) noexcept;
    /// The same over one sample.
    void tick(std::size_t count, double* amplitude, double* rate) const noexcept;

private:
    AlignedVector omega_, decay_, damped_;
    AlignedVector angle_, cosine_, sine_; ///< scratch
    AlignedVector tick_[4];               ///< q from q, q from q', q' from q, q' from q'
};

} // namespace ode::sound
