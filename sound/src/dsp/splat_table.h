#pragma once

#include "dsp/storage.h"

namespace ode::sound {

/// Weights that put a sample between the samples of a grid: Kaiser-windowed sinc of 16 taps.
///
/// Row p holds the weights for a fraction p / kPhases; fractions between rows are interpolated
/// linearly, which adds an error of pi^2/3 / (8 kPhases^2), -116 dB. Every row sums to one, so a
/// constant stays constant while its delay moves. Pass band to 0.25 cycles per sample, images from
/// 0.75 are 115 dB down.
class SplatTable {
public:
    static constexpr int kTaps = 16;
    static constexpr int kBefore = 7; ///< taps before the sample that the arrival rounds down to
    static constexpr int kAfter = kTaps - 1 - kBefore;
    static constexpr int kPhases = 512;

    SplatTable();
    const double* rows() const noexcept { return row_.data(); } ///< kPhases + 1 rows of kTaps

private:
    AlignedVector row_;
};

/// The one table, made at first use.
const SplatTable& splat_table();

} // namespace ode::sound
