#pragma once

#include "scenes/timoshenko.h"
#include "scenes/world.h"

#include <vector>

namespace scenes {

/// Wind chimes: tubes in a ring on threads, a clapper in their middle, and a sail below it that the
/// wind pulls.
struct Chimes {
    std::vector<double> notes = {523.251, 587.330, 659.255, 783.991, 880.000, 1046.502};
    ///< first partials [Hz]; a pentatonic scale on C
    double outer = 0.0125;  ///< radius of the tubes [m]
    double inner = 0.0105;  ///< [m]
    double ring = 0.065;    ///< of the tubes' axes [m]
    double clapper = 0.032; ///< radius [m]
    double gust = 3.0;      ///< mean speed of the wind [m/s]
    unsigned seed = 1;      ///< of the gusts
    double top = 2.0;       ///< where the threads hang, above the ground [m]
};

/// Aluminium that rings for seconds: loss of metal, threads and air together.
dSoftSolid chime_metal();

/// Chimes in a world.
struct ChimeBodies {
    struct Tube {
        dBodyID body;
        ode::soft::MeshHandle mesh; ///< its centre of mass at its middle
        ode::soft::TimoshenkoTube theory;
    };
    std::vector<Tube> tube;
    dBodyID clapper, sail;
    double gust;
    unsigned seed;

    /// Lets the wind blow on the sail for the coming step. @param time  [s].
    void blow(double time) const;
};

/// @throws Refused
ChimeBodies build(World& world, const Chimes& chimes);

/// Speed of the wind along x and y [m/s]: gusts that come and go within seconds, always the same
/// for one seed.
void wind(double mean, unsigned seed, double time, double out[2]);

} // namespace scenes
