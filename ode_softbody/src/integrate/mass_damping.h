#pragma once

#include "integrate/node_state.h"

namespace ode::soft {

/// Mass-proportional damping of deformation alone: velocities decay by exp(-alpha dt) towards those
/// of the rigid motion that carries the body's momentum, so that a body in flight neither drags nor
/// stops spinning (Rayleigh's own alpha M v would brake it like a viscous liquid).
///
/// Where the rate differs from node to node, the rigid motion is the one that the momentum lost
/// would give: what is taken sums to no force and no torque.
///
/// Held nodes take rigid motions away (RigidMotions): a body held at three decays towards rest.
/// @param held  the nodes of inverse mass 0, which keep their velocity.
/// @param alpha [1/s], one for all nodes or one a node.
/// @param dt    time since the last call [s]. The decay is slow (alpha is a few per second), so
///              that a call every few substeps costs nothing and changes nothing.
void damp_deformation(std::span<const double> mass, std::span<const double> inverse_mass,
                      std::span<const int> held, std::span<const double> alpha, double dt,
                      NodeState& state) noexcept;

} // namespace ode::soft
