#pragma once

#include "bench/time/time_scenes.h"

namespace ode::soft {

/// Distance of two waveforms over the length of the second [-]: 0 equal, 1 silence, 1.4 unrelated.
double waveform_error(const Waveform& waveform, const Waveform& reference);

/// What the modes of a ringing scene became.
struct RingingError {
    double cents = 0; ///< the worst of its modes
    double decay = 0; ///< relative, the worst of its modes
};

/// Frequencies and decay rates fitted to the waveform's shares in the modes' shapes, against the
/// scene's own. Infinite where a mode isn't to be found.
RingingError ringing_error(const TimeScene& scene, const Waveform& waveform);

} // namespace ode::soft
