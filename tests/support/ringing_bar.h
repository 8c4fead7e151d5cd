#pragma once

#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

namespace ode::test {

/// An application whose one soft body is a free steel bar at the origin.
struct RingingBar : OdeApp {
    /// @param beta  of Rayleigh's damping [s]
    explicit RingingBar(dReal beta) : soft(dSoftWorldCreate(world, space)) {
        const ode::soft::MeshHandle mesh(dSoftMeshCreateBox(0.2, 0.03, 0.02, 10, 1, 1));
        dSoftSolid steel = dSoftSolidDefault();
        steel.alpha = 0;
        steel.beta = beta;
        body = dSoftBodyCreate(soft, mesh, &steel);
        dSoftBodySetPosition(body, 0, 0, 0);
    }
    ode::soft::WorldHandle soft;
    dSoftBodyID body;
};

} // namespace ode::test
