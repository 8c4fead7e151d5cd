#pragma once

#include "base/types.h"

#include <cmath>

namespace ode::soft {

/// How a soft body's surface meets rigid ones.
struct ContactLaw {
    double friction = 0.5; ///< Coulomb's coefficient [-]; infinite sticks
    double stiffness = 0;  ///< penalty per area and depth [Pa/m]; 0: as stiff as the substep allows
    double damping = 3e-5; ///< time constant of the dashpots, force k (depth + damping * speed) [s]
};

// A contact spring on a node of mass m adds at most k dt^2 / m to dt^2 lambda, which leapfrog with
// lagged damping keeps stable while dt^2 lambda + 2 dt c / m <= 4. A substep of 0.9 of the critical
// one leaves 4 - 3.24 = 0.76; the soft side takes 0.324 + 2 * 0.075, a rigid body the rest
// (rigid_shadow.cpp). Eigenvalues of a sum are bounded by the sum, so this holds for any number of
// contacts.
constexpr double kStiffnessShare = 0.1 * 3.24; ///< of k dt^2 / m
constexpr double kDampingShare = 0.075;        ///< of c dt / m

constexpr double kTangential = 0.7; ///< tangential stiffness to normal, near Mindlin's for nu = 0.3

/// Shortens v to at most `most`. @return whether it had to.
inline bool clamp_length(Vec3& v, double most) noexcept {
    const double length2 = v.squaredNorm();
    if (!(length2 > most * most))
        return false;
    v *= most / std::sqrt(length2);
    return true;
}

} // namespace ode::soft
