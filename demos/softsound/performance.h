#pragma once

#include "scenes/world.h"
#include "softsound/command.h"

#include <array>
#include <functional>
#include <memory>
#include <ode_sound/sound.hpp>
#include <span>
#include <string>
#include <vector>

namespace softsound {

/// What every demo lets its user choose.
struct Stage {
    std::string name;        ///< of the demo
    double seconds = 2;      ///< simulated [s]
    double step = 1.0 / 240; ///< of ODE [s]
    std::string out;         ///< WAV
    std::string plot;        ///< PNG
    bool live = false;       ///< through OpenAL, too
    int threads = 1;         ///< threads.h
    std::string radiation = "monopole";
    std::string sampling = "sinc";
    double full_scale = 20;      ///< that becomes 1.0 in the file [Pa]
    dVector3 ear = {0, -1, 1.6}; ///< midpoint of the ears [m]; they look along +y, +z is up
};

/// What demos differ in: @param step  of ODE [s]. @param ear  midpoint [m]
Stage make_stage(std::string name, double seconds, double step, std::array<double, 3> ear);

/// Adds --out, --plot, --live, --seconds, --threads, --radiation, --sampling, --full-scale.
void add_stage(CLI::App& command, Stage& stage);

/// What a run gives.
struct Performance {
    double seconds = 0; ///< simulated [s]
    double cpu = 0;     ///< CPU time of all threads [s]
    double wall = 0;    ///< [s]
    dSoftWorldStats world = {};
    dSoundStats sound = {};
    std::vector<float> left; ///< what the left ear heard [Pa]
    int rate = 48000;        ///< [Hz]
    std::string live_kind;   ///< "openal", "null" (no device), "" (not asked for)
};

/// What a scene does besides being stepped.
struct Act {
    std::function<void(dSoundWorldID)> begin;     ///< before the first step
    std::function<void(double time)> before_step; ///< [s]
    std::function<void()> end;                    ///< before the sound world ends
};

/// Steps a world to its end with a listener in it, and leaves the sound in a file.
/// @throws scenes::Refused, std::runtime_error
Performance perform(scenes::World& world, const Stage& stage, bool quiet, const Act& act = {});

/// Results that every demo reports, as data.
nlohmann::ordered_json as_json(const Performance& performance);

/// Level of a peak pressure [dB re 20 uPa]; -infinity for silence.
double sound_pressure_level(double pressure);

} // namespace softsound
