#pragma once

#include "base/types.h"

#include <ode/collision.h>
#include <ode/contact.h>

#include <array>
#include <span>

namespace ode::soft {

/// Contacts of an ODE ray with a surface of triangles, by ODE's conventions: position on the
/// surface, normal against the ray, depth the distance from the ray's start [m], side1 the
/// triangle. Honours the ray's first-contact, backface-cull and closest-hit flags.
/// @param geom     becomes g1.
/// @param flags    low 16 bits: most contacts wanted.
/// @param skip     bytes from contact to contact.
/// @return contacts written.
int collide_ray(dGeomID geom, dGeomID ray, std::span<const std::array<int, 3>> triangles,
                const NodeArray& position, int flags, dContactGeom* contact, int skip) noexcept;

} // namespace ode::soft
