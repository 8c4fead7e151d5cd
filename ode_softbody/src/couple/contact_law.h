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
    double weight = 0; ///< of the soft body, which it may come to rest under [N]

    bool operator==(const ContactLaw&) const = default;
};

// A contact spring on a node of mass m adds at most k dt^2 / m to dt^2 lambda, which leapfrog with
// lagged damping keeps stable while dt^2 lambda + 2 dt c / m <= 4. A substep of 0.9 of the critical
// one leaves 4 - 3.24 = 0.76; the soft side takes 0.324 + 2 * 0.075, friction on a rigid body the
// rest (rigid_shadow.cpp). Eigenvalues of a sum are bounded by the sum, so this holds for any
// number of contacts.
constexpr double kStiffnessShare = 0.1 * 3.24; ///< of k dt^2 / m
constexpr double kDampingShare = 0.075;        ///< of c dt / m

constexpr double kTangential = 0.7; ///< tangential stiffness to normal, near Mindlin's for nu = 0.3

/// Normal force of a contact over a substep.
struct Press {
    double force = 0;  ///< [N], >= 0
    double spring = 0; ///< its conserving part [N]
    double slope = 0;  ///< derivative by the depth that was to be reached [N/m], >= 0
};

/// Normal force of one contact over a substep: a spring that keeps energy and a dashpot that can
/// only take it, both between the depth a substep ago, a, and the depth b that is reached under
/// their own force: F = (V(b) - V(a)) / (b - a) + c (b - a) / (2 dt). Speeds are of approach.
struct NormalContact {
    double stiffness;  ///< [N/m]
    double damping;    ///< [N s/m]
    double compliance; ///< inverse effective mass along the normal of what yields to it [1/kg]
    double depth;      ///< now [m]
    double speed;      ///< half a substep ago [m/s]
    double ahead;      ///< in half a substep, if it weren't for this contact [m/s]
    const HertzSpring* point = nullptr; ///< instead of `stiffness`, where the contact is a point
    double owed = 0; ///< energy to take beyond the potential's [J], see EnergyBook

    double energy(double at) const noexcept {
        const double in = std::fmax(0.0, at);
        return point ? point->energy(in) : stiffness * in * in / 2;
    }

    // Inlined, so that a caller who needs the force alone pays for no slope.
    [[gnu::always_inline]] Press press(double dt) const noexcept {
        const double before = depth - dt * speed;
        const double free = depth + dt * ahead;
        if (before <= 0 && free <= 0)
            return {};
        // The dashpot is linear: it makes the masses heavier and the free depth nearer.
        const double g = dt * dt * compliance;
        const double drag = damping / (2 * dt);
        const double scale = 1 / (1 + g * drag);
        const double start = (free + g * drag * before) * scale;
        double spring = point ? point->press(g * scale, before, start)
                              : conserving_press(stiffness, g * scale, before, start);
        const double reached = start - g * scale * spring;
        const double way = reached - before;
        const bool still = std::fabs(way) < 1e-9 * std::fabs(before);
        const double now = point ? point->force(reached) : stiffness * std::fmax(0.0, reached);
        const double bend =
            still ? (point ? point->steep() : stiffness) / 2 : std::fmax(0.0, (now - spring) / way);
        if (owed != 0) { // owed / way, where the way is long enough to work on
            const double least = kLongWay * std::fmax(std::fabs(before), std::fabs(reached));
            const double mend = owed * way / (way * way + least * least);
            spring += std::clamp(mend, -kMend * spring, kMend * spring);
        }
        const double force = spring + drag * way;
        if (!(spring > 0 && force > 0))
            return {};
        return {force, spring, (bend + drag) / (1 + g * (bend + drag))};
    }

private:
    static constexpr double kMend = 0.5;    ///< of its force, to mend what energy was missed
    static constexpr double kLongWay = 0.1; ///< of the depth, in a substep
};

/// What a spring has taken, against what it should have.
///
/// The depth that a substep is to reach is found along straight lines; a light body that turns by
/// degrees in a substep gets elsewhere. After a substep the spring should
/// hold (V(b) + V(d)) / 2. What it holds less or more it takes or gives next, or several per cent
/// of the energy of a shot would come from nowhere. In time the book is forgotten: a contact that
/// lasts moves little in a substep, and shall not be shaken for what its closest point did once.
class EnergyBook {
public:
    /// A substep's start. @return what the spring owes [J].
    double open(const NormalContact& spring, double dt) noexcept {
        const double ago = spring.energy(spring.depth - dt * spring.speed);
        const double now = spring.energy(spring.depth);
        if (!open_)
            taken_ = (ago + now) / 2;
        open_ = ago > 0 || now > 0;
        taken_ += kForget * ((ago + now) / 2 - taken_);
        return ago + now - 2 * taken_;
    }
    /// Its end. @param spring  force [N]. @param way  of approach in the substep before and in this
    /// one [m].
    void enter(double spring, double way) noexcept {
        taken_ += spring * way / 2;
        open_ = open_ || spring > 0;
    }
    void close() noexcept { *this = {}; }
    /// Whether a body turns so much in a substep that its contacts need a book.
    static bool is_needed(const Vec3& spin, double dt) noexcept {
        return spin.squaredNorm() * dt * dt > kTurn * kTurn;
    }

private:
    static constexpr double kForget = 0.02;
    static constexpr double kTurn = 1e-3; ///< [rad]

    bool open_ = false;
    double taken_ = 0; ///< [J]
};

/// Depth in which a contact was first seen, where a body was put into another, or was moved there
/// by ODE alone: hidden from the force at first and shown slowly, or the parts would be shot off by
/// energy that nobody paid. What may have been reached in a substep at the speed of approach
/// counts.
class Overlap {
public:
    /// @param depth     now [m]. @param approach  speed of approach [m/s].
    /// @return what the force is not to see of the depth [m].
    double hidden(double depth, double approach, double dt) noexcept {
        if (!seen_)
            hidden_ = depth - std::fmax(0.0, approach) * dt;
        seen_ = true;
        if (!(hidden_ > 0))
            return 0;
        hidden_ = std::fmin(hidden_ * (1 - kShown * dt), depth);
        return std::fmax(0.0, hidden_);
    }

private:
    static constexpr double kShown = 4; ///< [1/s]

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
