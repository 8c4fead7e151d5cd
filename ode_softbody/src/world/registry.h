#pragma once

#include <ode/common.h>

namespace ode::soft {

class SoftWorld;

/// All soft worlds of the process, by the ODE world they live in: at most one each. Guarded by a
/// lock, since applications may step different worlds from different threads.

/// @throws InputError when the ODE world has a soft world already.
SoftWorld& create_world(dWorldID world, dSpaceID space);

/// Ends observers, bodies and geoms, in this order.
void destroy_world(SoftWorld& world) noexcept;

/// nullptr when there is none. Costs one atomic load while the process has no soft world.
SoftWorld* find_world(dWorldID world) noexcept;

/// The application has destroyed an ODE world, or closed ODE (nullptr: all of them).
void forget_world(dWorldID world) noexcept;

/// The application destroys a space (or a geom): soft worlds that make their bodies in it can't any
/// more. Costs one atomic load while the process has no soft world.
void lose_space(dGeomID space) noexcept;

} // namespace ode::soft
