#pragma once

#include "strike/struck_surface.h"

#include <ode/ode.h>

#include <vector>

namespace ode::sound {

/// A place where geoms of two bodies overlap, found again for a joint that nobody saw being made.
struct RecalledContact {
    dGeomID geom[2]; ///< of the first and of the second body
    Vec3 position;   ///< [m]
    Vec3 normal;     ///< into the first body
    double depth;    ///< [m]
};

/// All places where a body overlaps another, or the ground: the fixed geoms of its own space.
/// Before ODE's step, when all lies as it lay for the application's near callback. Asks each pair
/// of geoms whose boxes overlap: no cost but for joints that are not seen.
/// @param second  null: the ground.  @param out  added to.
void recall_contacts(dBodyID first, dBodyID second, std::vector<RecalledContact>& out);

} // namespace ode::sound
