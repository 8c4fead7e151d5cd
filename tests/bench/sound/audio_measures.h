#pragma once

#include "physics/sound/rig.h"

#include <string>

namespace ode::sound::test {

/// How a body's substeps follow each other.
struct Substeps {
    std::string name;
    double mean;   ///< [s]
    double spread; ///< each is mean (1 +- spread), by a fixed pattern
};

/// A small sphere that pulsates, half a metre from one ear.
struct Tone {
    double level; ///< over a point source's [dB]
    double rest;  ///< all of the recording from 20 Hz to 20 kHz, over the same [dB]
};
Tone tone(const Settings& settings, const Substeps& substeps, double frequency);

/// What is heard of a point that flies at an ear with 10 m/s, less the tone that theory gives it,
/// over the tone, 20 Hz to 20 kHz [dB].
double distortion(const Settings& settings, double frequency);

/// Pitch of a source that passes with +-30 m/s, relative error; the worse of both.
double doppler_error(const Settings& settings);

struct Arrival {
    double samples;      ///< error of a sound's arrival
    double microseconds; ///< error of the time between two ears
};
Arrival arrival_error(const Settings& settings);

/// From the end of the step that holds a frame to the frame's own time, longest, for steps of no
/// length [ms].
double latency(const Settings& settings);

/// Loudest sample, over the loudest of a source at rest a metre away [dB], while something improper
/// happens; NaN when a sample is not finite.
enum class Improper { kSourcePassesThroughEar, kSupersonicSource, kEarTeleports, kSourceTeleports };
double loudest(const Settings& settings, Improper what);

} // namespace ode::sound::test
