#pragma once

#include <ode/common.h>

#include <memory>
#include <span>

namespace ode::soft {

class Body;
class RigidExchange;

/// Tells soft bodies of the moving rigid geoms that will come within their reach during a step of h
/// [s], though they are still outside: ODE's boxes know of no motion, and a body first seen in the
/// step after would be v h deep. Looks into nested spaces; obeys category and collide bits.
/// Quadtree spaces can't be listed: what they hold is met once its box overlaps.
/// The exchange hears of every body that is awake and has a geom.
void sweep_rigid(dSpaceID space, double h, std::span<const std::unique_ptr<Body>> bodies,
                 RigidExchange& exchange) noexcept;

} // namespace ode::soft
