#pragma once

#include "base/types.h"

#include "couple/conserving_spring.h"
#include "couple/hertz_spring.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {

/// How a soft body's surface meets rigid ones.
struct ContactLaw {
    double friction = 0.5; ///< Coulomb's coefficient [-]; infinite sticks
    double stiffness = 0;  ///< penalty per area and depth [Pa/m]; 0: as stiff as the substep allows
    double damping = 3e-5; ///< time constant of the dashpots, force k (depth + damping * speed) [s]
    /// (1 - nu^2) / E of the rigid side's solid, which yields to a point like any other; 0: rigid
    /// [1/Pa].
    double rigid_compliance = 0;

    bool operator==(const ContactLaw&) const = default;
};

// A contact spring on a node of mass m adds at most k dt^2 / m to dt^2 lambda, which leapfrog with
// lagged damping keeps stable while dt^2 lambda + 2 dt c / m <= 4. A substep of 0.9 of the critical
// one leaves 4 - 3.24 = 0.76; the soft side takes 0.324 + 2 * 0.075, a rigid body the rest
// (rigid_shadow.cpp). Eigenvalues of a sum are bounded by the sum, so this holds for any number of
// contacts.
constexpr double kStiffnessShare = 0.1 * 3.24; ///< of k dt^2 / m
constexpr double kDampingShare = 0.075;        ///< of c dt / m

constexpr double kTangential = 0.7; ///< tangential stiffness to normal, near Mindlin's for nu = 0.3

/// Normal force of one contact over a substep: a spring that keeps energy and a dashpot that can
/// only take it. Speeds are of approach.
struct NormalContact {
    double stiffness;  ///< [N/m]
    double damping;    ///< [N s/m]
    double compliance; ///< inverse effective mass of both sides along the normal [1/kg]
    double depth;      ///< now [m]
    double speed;      ///< half a substep ago [m/s]
    double ahead;      ///< in half a substep, if it weren't for this contact [m/s]
    const HertzSpring* point = nullptr; ///< instead of `stiffness`, where the contact is a point

    /// @return [N], >= 0
    double press(double dt) const noexcept {
        const double before = depth - dt * speed;
        const double free = depth + dt * ahead;
        const double g = dt * dt * compliance;
        const double spring =
            point ? point->press(g, before, free) : conserving_press(stiffness, g, before, free);
        if (spring == 0)
            return 0;
        const double mean_speed = (free - g * spring - before) / (2 * dt);
        return std::max(0.0, spring + damping * mean_speed / (1 + dt * compliance * damping / 2));
    }
};

/// Depth in which a contact was first seen, where a body was put into another: hidden from the
/// force at first and shown slowly, or the parts would be shot off by energy that nobody paid. What
/// may have been reached at the speed of approach since the last look was paid for.
class Overlap {
public:
    /// @param depth     now [m]. @param approach  speed of approach [m/s].
    /// @return what the force is not to see of the depth [m].
    double hidden(double depth, double approach, double dt) noexcept {
        if (!seen_)
            hidden_ = depth - std::fmax(0.0, approach) * kLongestStep;
        seen_ = true;
        if (!(hidden_ > 0))
            return 0;
        hidden_ = std::fmin(hidden_ * (1 - kShown * dt), depth);
        return std::fmax(0.0, hidden_);
    }

private:
    static constexpr double kLongestStep = 0.02; ///< of the application's [s]
    static constexpr double kShown = 4;          ///< [1/s]

    double hidden_ = 0;
    bool seen_ = false;
};

// A point is looked at once it may touch within this many times the way that its present speed
// makes in a substep: forces may speed it up.
constexpr double kForesight = 4;

/// Shortens v to at most `most`. @return whether it had to.
inline bool clamp_length(Vec3& v, double most) noexcept {
    const double length2 = v.squaredNorm();
    if (!(length2 > most * most))
        return false;
    v *= most / std::sqrt(length2);
    return true;
}

} // namespace ode::soft
