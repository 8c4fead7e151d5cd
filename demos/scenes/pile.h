#pragma once

#include "scenes/world.h"

#include <vector>

namespace scenes {

/// Soft cubes and slabs and rigid boxes and balls, turned at random, let fall into a square bin;
/// or, without a bin, thrown at each other in empty space.
struct Pile {
    int soft = 100;
    int rigid = 20;
    double size = 0.1;    ///< of each body [m]
    double young = 1e5;   ///< [Pa]
    double density = 500; ///< of all [kg/m^3]
    double alpha = 20;    ///< material damping [1/s]
    double beta = 2e-3;   ///< of material and contact [s]
    double friction = 0.5;
    bool bin = true;       ///< floor, walls and gravity
    bool may_rest = false; ///< bodies that lie still are disabled
    unsigned seed = 1;     ///< of places and orientations
};

/// What a pile is made of, and the bin's half width [m].
struct PileBodies {
    std::vector<dSoftBodyID> soft;
    std::vector<dBodyID> rigid;
    double half = 0;
};

/// @throws Refused
PileBodies build(World& world, const Pile& pile);

/// Of all bodies of a pile together. Velocities are half a substep or half a step back.
struct PileState {
    double kinetic = 0;   ///< [J]
    double elastic = 0;   ///< [J]
    double potential = 0; ///< above z = 0 [J]
    double fastest = 0;   ///< node, or centre of a rigid body [m/s]
    dVector3 momentum = {};
    dVector3 angular = {}; ///< about the origin
    double throughput = 0; ///< sum of the bodies' momenta's sizes [kg m/s]
    double lowest = 0;     ///< centre [m]
    double widest = 0;     ///< centre's distance from the middle, along x or y [m]
    double closest = 0;    ///< two centres [m]
    bool any_stopped = false;

    double energy() const { return kinetic + elastic + potential; }
};
PileState look_at(const PileBodies& bodies, double gravity);

} // namespace scenes
