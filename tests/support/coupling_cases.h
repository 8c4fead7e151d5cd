#pragma once

#include "base/types.h"

#include <ode/ode.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ode::test {

/// Rigid bodies, jointed or not, about to hit a soft one. The same scene is run by the library,
/// with ODE's steps of length h, and by a reference that steps ODE itself at the substep.
struct CouplingCase {
    std::string name;
    double seconds = 0.08;
    /// Makes bodies and joints. The first body is watched.
    std::function<std::vector<dBodyID>(dWorldID, dSpaceID)> rig;
    double soft_mass_factor = 1; ///< of the plate's density and stiffness alike
    bool clamped = true;         ///< the plate's rim, else it floats
};

/// What a run shows.
struct CouplingRun {
    soft::Vec3 impulse = soft::Vec3::Zero(); ///< on all bodies of the rig, by the soft one [N s]
    double peak = 0;                         ///< largest contact force on them [N]
    double energy_before = 0;                ///< rigid and soft, gravity included [J]
    double energy_after = 0;
    std::vector<soft::Vec3> path; ///< centre of the watched body, every 16 ms [m]
    double length = 0;            ///< of its path, reference only [m]
    int steps_apart = 0;          ///< in which the rig was out of reach, library only
    double seconds = 0;           ///< of CPU
    unsigned long mirror_steps = 0;
};

constexpr double kCouplingSubstep = 1e-5; ///< [s]

/// A rod hinged to the world whose tip falls on a plate; a ball on a light rod that swings against
/// a bar clamped upright; four balls on ball joints, the last of which hits a plate.
std::vector<CouplingCase> coupling_cases();
/// The rod on a block that floats, of `ratio` times its mass.
CouplingCase mass_ratio_case(double ratio);

CouplingRun run_library(const CouplingCase& c, double h);
/// ODE stepped and contacts found anew wholly at the substep, by a loop of its own.
CouplingRun run_reference(const CouplingCase& c);

} // namespace ode::test
