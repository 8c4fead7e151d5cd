#pragma once

#include "couple/contact_law.h"
#include "couple/node_forces.h"
#include "couple/soft_surface.h"

#include <span>

namespace ode::soft {

/// What a contact sees of a soft body in a substep. All borrowed.
struct SoftSide {
    const NodeArray& position;
    const NodeArray& velocity;            ///< half a substep back
    std::span<const double> inverse_mass; ///< of every mesh node [1/kg]; 0: held
    NodeForces force;                     ///< all that acts, contact last [N]
};

/// A body's part in a pair, settled at the start of a step.
struct SoftPartner {
    SoftSurface& surface;
    const ContactLaw& law;
    double substep; ///< the body's own, nominal [s]
};

/// How two soft surfaces meet: ContactLaw of both, made one.
///
/// Friction: geometric mean of both coefficients, so that a body without friction
/// has none with anybody. Penalty: the softer one asked for, at most what both sides' nodes bear:
/// friction's share is a third of kStiffnessShare / substep^2 * mass per area of the lighter side,
/// the normal spring, stable at any stiffness, seven times that. It hangs on nominal substeps
/// alone, so that the springs' potential is the same throughout. Dashpots: mean time constant.
struct PairLaw {
    double friction = 0;
    double stiffness = 0; ///< [Pa/m]
    double damping = 0;   ///< [s]
    // What a node bears beside the material, in each body's own nominal substep:
    double bearable_point = 0; ///< spring, of the body with the points [1/s^2]
    double bearable_face = 0;
    double hardness = 1;               ///< normal to bearable stiffness
    double bearable_point_damping = 0; ///< dashpot [1/s]
    double bearable_face_damping = 0;
};

/// @param points  the side called so: either, where both are alike.
PairLaw make_pair_law(const SoftPartner& points, const SoftPartner& faces) noexcept;

} // namespace ode::soft
