#pragma once

#include "scenes/world.h"

#include <string>

namespace scenes {

/// A soft body let go above a floor.
struct Drop {
    std::string mesh;               ///< file to load; empty: the bowl below
    std::string material = "steel"; ///< a preset's name
    int order = 0;                  ///< of the elements; 0: the mesh's own
    std::string model = "stvk";     ///< constitutive law
    double height = 0.5;            ///< of the lowest node above the floor [m]
    double tilt = 0.3;              ///< from upright, about x [rad]
    double step = 1.0 / 240;        ///< of ODE [s]
};

/// The source paper's bowl (its 387 nodes, 1081 tetrahedra), as near as rings of whole elements
/// allow: a hemisphere of radius 0.1 m and 5 mm thickness, 434 nodes, 1152 tetrahedra.
ode::soft::MeshHandle paper_bowl();

/// Builds a drop in a world: floor z = 0, one body. @throws Refused
dSoftBodyID build(World& world, const Drop& drop);

} // namespace scenes
