#pragma once

#include <ode/common.h>

namespace ode::conformance {

// What a preloaded library hears of the program's own calls of ODE. Each library defines these.

void on_world(dWorldID world);       ///< just made
void on_world_end(dWorldID world);   ///< about to be destroyed
void on_space(dSpaceID space);       ///< just made, of whatever kind, nested or not
void on_space_end(dSpaceID space);   ///< just destroyed: an address, no more
void on_body_placed(dWorldID world); ///< one of its bodies is about to be given a position
void on_collide(dSpaceID space);     ///< about to be collided, not locked yet
void on_closed();                    ///< ODE is closed: all worlds have ended

} // namespace ode::conformance
