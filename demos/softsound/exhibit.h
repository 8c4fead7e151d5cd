#pragma once

#include "plots/partials.h"
#include "scenes/world.h"
#include "softsound/command.h"
#include "softsound/performance.h"
#include "softsound/subject.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// What the demos of the source paper's examples have in common: a scene that is built, driven,
/// heard, drawn and measured.
namespace softsound {

/// What a user may choose of a demo, and what it starts from.
struct Exhibit {
    Stage stage = {};
    std::string title = {};               ///< of the picture
    std::string tier = "auto";            ///< tier.h
    int order = 2;                        ///< of the elements
    double top = 10000;                   ///< highest frequency shown [Hz]
    double ring_from = 0.1;               ///< partials are looked for from here on [s]
    int cells = 0;                        ///< of the mesh along its side; 0: nothing to choose
    bool judges_elements = false;         ///< tells first_mode() as well: seconds for a large mesh
    std::vector<std::string> choice = {}; ///< names of --tier; empty: there is nothing to choose
};

/// A scene as its builder leaves it.
struct Shown {
    dSoftBodyID body = nullptr;
    int elements = 0;
    std::string material;
    std::shared_ptr<ode::soft::MeshHandle> mesh; ///< null: nobody asks for first_mode()
    dSoftSolid solid = {};
    std::vector<int> held;         ///< pinned nodes
    std::vector<double> predicted; ///< partials, by whatever theory the demo names [Hz]
    std::string theory;            ///< its name
    /// Called before every step of ODE's. @param time  of the world [s]
    std::function<void(double time)> drive;
};

using Build = std::function<Shown(scenes::World& world, const Exhibit& exhibit)>;
/// Adds figures of its own to the results.
using Judge = std::function<void(nlohmann::ordered_json& results, const Performance& performance,
                                 const Shown& shown)>;

/// Registers a demo: its options, its run, its files.
/// @param about  mathematics and expected result, for --help
void add_exhibit(CLI::App& demo, Common& common, const Exhibit& exhibit, const std::string& what,
                 const std::string& about, Build build, Judge judge = {});

/// Builds, performs, measures, draws, reports.
int run_exhibit(const Exhibit& exhibit, const Build& build, const Judge& judge,
                const Common& common);

/// Sets order and tier, then holds or frees nothing. @throws scenes::Refused
void shape(dSoftBodyID body, const Exhibit& exhibit);

/// A body of this mesh in the form that the exhibit asks for. @throws scenes::Refused
Shown show(scenes::World& world, const Exhibit& exhibit, ode::soft::MeshHandle mesh,
           const dSoftSolid& solid, const std::string& material);
/// Pins the nodes that a condition holds for, by their places now.
void hold(Shown& shown, const std::function<bool(const dReal*)>& condition);

/// Partials as the results list them.
nlohmann::ordered_json as_json(const std::vector<plots::Partial>& partials);

/// Level of the strongest line within `reach` [cents] of a frequency [dB re 1 Pa].
double level_near(std::span<const float> ring, double rate, double frequency, double reach = 30);

} // namespace softsound
