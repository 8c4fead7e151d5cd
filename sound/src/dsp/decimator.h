#pragma once

#include "dsp/storage.h"

namespace ode::sound {

/// Halves a sample rate, and differentiates by time on the way when asked to.
///
/// Symmetric (or, differentiating, antisymmetric) Kaiser-windowed sinc, so its delay is
/// reach() input samples at every frequency. Flat to 20 kHz, 100 dB down from the first frequency
/// that would fold back below 20 kHz (from half the output rate on at 48 kHz and above).
class Decimator {
public:
    enum class Kind { kSmooth, kDerivative };

    /// @param rate  of the output [Hz].
    Decimator(double rate, Kind kind, double gain);

    /// Input samples needed on each side of the one that an output falls on.
    int reach() const noexcept { return reach_; }

    /// @param first  2 reach() + 1 input samples.
    double operator()(const double* first) const noexcept;

    /// reach() of any decimator to this output rate.
    static int reach_for(double rate) noexcept;
    static double pass_edge(double rate) noexcept; ///< [Hz]
    static double stop_edge(double rate) noexcept; ///< [Hz]

private:
    int reach_;
    AlignedVector tap_; ///< time reversed, padded with zeros to a multiple of four
};

} // namespace ode::sound
