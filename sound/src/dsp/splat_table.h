#pragma once

#include "dsp/storage.h"

namespace ode::sound {

/// Weights that put a sample between the samples of a grid: Kaiser-windowed sinc of 16 taps.
///
/// Row p holds the weights for a fraction p / kPhases; between rows they are interpolated, 120 dB
/// down. Pass band to 0.208 cycles per sample (20 kHz of 96),
/// images from 0.792 are 140 dB down.
///
/// That much is needed since a body in flight moves far more air, back and forth, than its
/// vibration does: images of that steady flow are tones at multiples of (v/c) times the grid's
/// rate. Every row sums to one, which puts a zero of the kernel's spectrum beside them.
class SplatTable {
public:
    static constexpr int kTaps = 16;
    static constexpr int kBefore = 7; ///< taps before the sample that the arrival rounds down to
    static constexpr int kAfter = kTaps - 1 - kBefore;
    static constexpr int kPhases = 512;

    SplatTable();
    /// Row 0; kPhases more behind it.
    const double* rows() const noexcept { return row_.data(); }

    /// The same in floats.
    const float* float_rows() const noexcept { return float_row_.data(); }

    /// Tap j for a fraction f of a sample is the sum of moments()[m kTaps + j] (f - 1/2)^m: the
    /// rows at Chebyshev's points, 120 dB down between them.
    static constexpr int kMoments = 8;
    const double* moments() const noexcept { return moment_.data(); }

private:
    AlignedVector moment_;
    AlignedVector row_;
    AlignedFloats float_row_;
};

/// The one table, made at first use.
const SplatTable& splat_table();

} // namespace ode::sound
