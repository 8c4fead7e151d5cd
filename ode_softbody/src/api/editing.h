#pragma once

#include "base/error.h"
#include "hook/collision_hook.h"
#include "world/soft_world.h"

#include <ode/collision.h>

#include <algorithm>

namespace ode::soft {

/// Whether bodies, geoms and observers may come, go and be moved at this moment: not while the
/// world calls its observers, nor while ODE has locked a space to walk through it.
/// @return false after a sentence.
inline bool may_edit(const SoftWorld& world, const char* function) {
    if (world.busy()) {
        report(format("%s: refused within a step or an observer's callback; call it between steps",
                      function));
        return false;
    }
    const auto& bodies = world.bodies();
    if (is_locked(world.space()) || std::any_of(bodies.begin(), bodies.end(), [](const auto& body) {
            return body->geom() && is_locked(dGeomGetSpace(body->geom()));
        })) {
        report(format("%s: refused within a near callback, whose space is locked; call it after "
                      "dSpaceCollide() has returned",
                      function));
        return false;
    }
    return true;
}

} // namespace ode::soft
