#include "softsound/modes.h"

#include "scenes/world.h"

#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace softsound {
namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw std::runtime_error(sentence); }

double read_number(const std::string& text, const std::string& whole) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end)
        refuse("--material " + whole + ": '" + text +
               "' is no number; write E:NU:RHO in Pa, none, kg/m^3, such as 2e11:0.29:7850");
    return value;
}

/// Numbers say nothing of damping; the default solid's is steel's.
void undamp(dSoftSolid& solid) {
    solid.phi = solid.psi = solid.alpha = solid.beta = solid.loss_factor = 0;
}

/// A preset's name or E:NU:RHO.
dSoftSolid read_solid(const std::string& text, const std::string& whole) {
    dSoftSolid solid = dSoftSolidDefault();
    const std::size_t one = text.find(':');
    if (one == std::string::npos) {
        if (!dSoftSolidPreset(text.c_str(), &solid))
            throw scenes::Refused(text);
        return solid;
    }
    const std::size_t two = text.find(':', one + 1);
    if (two == std::string::npos)
        refuse("--material " + whole +
               ": three numbers are needed, E:NU:RHO in Pa, none, kg/m^3, such as 2e11:0.29:7850");
    undamp(solid);
    solid.young = read_number(text.substr(0, one), whole);
    solid.poisson = read_number(text.substr(one + 1, two - one - 1), whole);
    solid.density = read_number(text.substr(two + 1), whole);
    return solid;
}

int group_named(dSoftMeshID mesh, const std::string& name) {
    std::string known;
    for (int i = 0; i < dSoftMeshGetGroupCount(mesh); ++i) {
        if (name == dSoftMeshGetGroupName(mesh, i))
            return i;
        known += (known.empty() ? "" : ", ") + std::string(dSoftMeshGetGroupName(mesh, i));
    }
    refuse("the mesh has no physical group '" + name + "'; " +
           (known.empty() ? "it has none at all: write --material without GROUP="
                          : "there are: " + known));
}

/// From --young, --poisson, --density, if any of them is there.
std::optional<dSoftSolid> by_numbers(const MaterialChoice& c) {
    if (!c.young && !c.poisson && !c.density)
        return {};
    if (!c.young || !c.poisson || !c.density)
        refuse("--young, --poisson and --density belong together: give all three");
    dSoftSolid solid = dSoftSolidDefault();
    undamp(solid);
    solid.young = *c.young;
    solid.poisson = *c.poisson;
    solid.density = *c.density;
    return solid;
}

} // namespace

void add_material(CLI::App& command, MaterialChoice& c) {
    std::string known;
    for (int i = 0; dSoftSolidPresetName(i); ++i)
        known += (i ? ", " : "") + std::string(dSoftSolidPresetName(i));
    command
        .add_option("--material", c.given,
                    "NAME or E:NU:RHO (Pa, none, kg/m^3) for all, GROUP=... for a physical group. "
                    "Names: " +
                        known)
        ->type_name("MATERIAL")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--young", c.young, "Young's modulus")->type_name("PA");
    command.add_option("--poisson", c.poisson, "Poisson's ratio")->type_name("RATIO");
    command.add_option("--density", c.density, "Density at rest")->type_name("KG/M3");
}

std::vector<dSoftSolid> choose_solids(dSoftMeshID mesh, const MaterialChoice& choice) {
    std::optional<dSoftSolid> all = by_numbers(choice);
    const int groups = dSoftMeshGetGroupCount(mesh);
    std::vector<std::optional<dSoftSolid>> own(static_cast<std::size_t>(groups));
    for (const std::string& text : choice.given) {
        const std::size_t equals = text.find('=');
        if (equals != std::string::npos) {
            const int group = group_named(mesh, text.substr(0, equals));
            own[static_cast<std::size_t>(group)] = read_solid(text.substr(equals + 1), text);
            continue;
        }
        if (all)
            refuse("--material " + text +
                   ": the material of all groups was given before; write GROUP=" + text +
                   " for one of them");
        all = read_solid(text, text);
    }
    if (groups == 0 && !all)
        refuse("no material: give --material NAME, or --young, --poisson and --density");
    if (groups == 0)
        return {*all};
    std::vector<dSoftSolid> solids;
    for (int i = 0; i < groups; ++i) {
        const std::optional<dSoftSolid>& mine = own[static_cast<std::size_t>(i)];
        if (!mine && !all) {
            const std::string name = dSoftMeshGetGroupName(mesh, i);
            refuse("no material for the physical group '" + name + "': give --material " + name +
                   "=NAME, or --material NAME for all");
        }
        solids.push_back(mine ? *mine : *all);
    }
    return solids;
}

} // namespace softsound
