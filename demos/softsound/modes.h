#pragma once

#include <CLI/CLI.hpp>
#include <ode_softbody/softbody.h>
#include <optional>
#include <string>
#include <vector>

/// What `modes` reads off its command line besides numbers: materials by group, clamps by position.
namespace softsound {

/// A solid for every group, as the user names them.
struct MaterialChoice {
    std::vector<std::string> given; ///< NAME, E:NU:RHO, GROUP=NAME or GROUP=E:NU:RHO
    std::optional<double> young;    ///< [Pa]
    std::optional<double> poisson;  ///< [-]
    std::optional<double> density;  ///< [kg/m^3]
};

/// Adds --material, --young, --poisson, --density.
void add_material(CLI::App& command, MaterialChoice& choice);

/// One solid for each group of the mesh, or one for a mesh without groups.
/// @throws std::runtime_error naming the group or value and what to do
std::vector<dSoftSolid> choose_solids(dSoftMeshID mesh, const MaterialChoice& choice);

struct Bounds {
    double low[3], high[3]; ///< [m]
};
Bounds bounds_of(dSoftMeshID mesh);

/// Nodes that meet any of the conditions, ascending.
/// @throws std::runtime_error for a condition that can't be read or catches no node
std::vector<int> clamped_nodes(dSoftMeshID mesh, const std::vector<std::string>& conditions);

} // namespace softsound
