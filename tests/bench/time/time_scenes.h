#pragma once

#include "integrate/node_state.h"
#include "mesh/tet_mesh.h"
#include "modal/modal_model.h"
#include "model/solid.h"

#include <string>
#include <vector>

namespace ode::soft {

/// A free body that is set moving, and what it ought to do.
struct TimeScene {
    std::string name, model;
    TetMesh mesh; ///< linear
    Solid solid;
    double duration; ///< [s]
    int samples;     ///< of its Waveform
    /// Velocity at the start [m/s] of every node of the promoted mesh: the mesh's own come first.
    std::vector<Vec3> start;
    /// Where the answer is a sum of damped modes: in closed form, from frequencies of the cubic
    /// order. Else empty, and the reference is a converged run.
    ModalModel modes;
    std::vector<double> amplitude; ///< of velocity of each mode, mass-normalised
    std::vector<double> decay;     ///< of each mode [1/s]

    bool closed_form() const noexcept { return !amplitude.empty(); }
};

/// Samples of the velocity of the mesh's own nodes [m/s], evenly over the duration, the start left
/// out.
using Waveform = std::vector<std::vector<Vec3>>;

/// A steel bar and a steel bowl, ringing in their four lowest modes at amplitudes small against
/// their thickness, and a rubber block that swings by a fifth of its own.
std::vector<TimeScene> time_scenes();

/// What a scene ought to do.
Waveform reference_of(const TimeScene& scene);

} // namespace ode::soft
