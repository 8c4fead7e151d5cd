#pragma once

#include "base/types.h"

#include <array>
#include <span>

namespace ode::soft {

/// Damped oscillators, each carried over a time by its exact solution
///
///     q'' + 2 d q' + w^2 q = 0,
///
/// so that any time is one step and none is too long. What a step needs of each oscillator (four
/// numbers) is kept for the lengths used lately: a body that is stepped by halves and doubles of a
/// length computes each but once. Allocates at construction alone.
class Oscillators {
public:
    /// @param omega  undamped, > 0 [rad/s]; a whole number of ModalBasis::kLanes.
    /// @param decay  d >= 0 [1/s]; above omega the motion creeps back.
    Oscillators(std::span<const double> omega, std::span<const double> decay);

    /// Advances amplitudes and their rates by dt [s]; of the first, or of all.
    void advance(double dt, std::span<double> amplitude, std::span<double> rate) noexcept;

    /// What pushes at the beginning have added by the end. @param impulse  to each rate, of the
    /// first.
    void respond(double dt, std::span<const double> impulse, std::span<double> amplitude,
                 std::span<double> rate) noexcept;
    /// Amplitude after dt for a unit of rate before [s].
    std::span<const double> drift(double dt) noexcept;

    std::size_t size() const noexcept { return omega_.size(); }

private:
    static constexpr std::size_t kLengths = 16;
    struct Length {
        double dt = 0;
        unsigned long used = 0;
        AlignedVector<double> table; ///< four rows: q from q, q from q', q' from q, q' from q'
    };
    const Length& length(double dt) noexcept;

    AlignedVector<double> omega_, decay_;
    std::array<Length, kLengths> length_;
    unsigned long clock_ = 0;
};

} // namespace ode::soft
