#pragma once

#include "base/types.h"

namespace ode::soft {

/// What a soft body does to a rigid one at one place in a substep.
struct RigidPush {
    Vec3 position; ///< world [m]
    Vec3 force;    ///< on the rigid body, world [N]
};

} // namespace ode::soft
