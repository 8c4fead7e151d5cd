#pragma once

#include "scenes/world.h"
#include "softsound/command.h"
#include "softsound/performance.h"

#include <functional>
#include <ode_sound/sound.hpp>
#include <string>
#include <vector>

/// What the demos of rigid bodies that sound have in common.
namespace softsound {

/// A rigid body of ODE's and what it rings as.
struct Ringer {
    std::string name;
    dBodyID body;
    ode::soft::MeshHandle mesh;
    dSoftSolid solid;
    double theory = 0;             ///< lowest partial by a closed form [Hz]; 0: none
    dSoundModalID voice = nullptr; ///< once the sound world is there
};

/// A scene as its builder leaves it.
struct RingerScene {
    std::vector<Ringer> ringer;
    /// Tells the sound world what geoms are made of.
    std::function<void(dSoundWorldID)> tell;
    /// Called before every step of ODE's. @param time  of the world [s]
    std::function<void(double time)> drive;
};

struct RingerShow {
    Stage stage;
    std::string title;  ///< of the picture
    double top = 20000; ///< highest frequency shown [Hz]
};

using BuildRingers = std::function<RingerScene(scenes::World& world)>;
/// Adds figures of its own to the results.
using JudgeRingers = std::function<void(nlohmann::ordered_json& results, const Performance& p)>;

/// Registers a demo: its options, its run, its files.
/// @param about  mathematics and expected result, for --help
void add_ringers(CLI::App& demo, Common& common, const RingerShow& show, const std::string& what,
                 const std::string& about, BuildRingers build, JudgeRingers judge);

/// A rigid body in the form of a box, with its geom. Its centre lies at `at` [m].
dBodyID box_of(scenes::World& world, const dSoftSolid& solid, const dVector3 size,
               const dVector3 at);
dBodyID ball_of(scenes::World& world, const dSoftSolid& solid, double radius, const dVector3 at);

/// A material by its name. @throws scenes::Refused
dSoftSolid solid_of(const char* name);

/// Root mean square of what was heard in a stretch of time [Pa].
double rms(const Performance& p, double from, double to);

} // namespace softsound
