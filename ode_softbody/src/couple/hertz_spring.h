#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {

/// k of Hertz's F = k d^1.5 [N/m^1.5], for contact ellipses too: exact for circles, else by the
/// approximation of J. A. Greenwood, Int. J. Mech. Sci. 39 (1997), within 1 % (K. L. Johnson,
/// Contact Mechanics, 1985, 4.26).
/// @param modulus  E* of both sides [Pa]
/// @param larger, smaller  principal curvatures of the gap, > 0 [1/m]
inline double hertz_stiffness(double modulus, double larger, double smaller) noexcept {
    const double shape = 1 - std::pow(std::pow(larger / smaller, 0.0684) - 1, 1.531);
    return 4.0 / 3 * modulus / (std::sqrt(std::sqrt(larger * smaller)) * std::pow(shape, 1.5));
}

/// Force of a point contact between smooth surfaces on a mesh: Hertz's law less what the mesh
/// yields by itself, for at a point it yields as a solid does, only too much or too little.
///     depth(F) = (F / k)^(2/3) - C F,   k = 4/3 E* sqrt(R)
/// with the mesh's compliance C under a point load (H. Hertz, J. reine angew. Math. 92 (1882);
/// K. L. Johnson, Contact Mechanics, 1985, 4.2). Depth is that of the undeformed shapes on the
/// deformed mesh. Where contact grows as wide as the mesh is fine, the mesh is the spring: from
/// there on the force goes on straight, so steep that depth hardly grows. Force is a function of
/// depth alone and so has a potential.
///
/// In terms of s = F^(1/3), a = k^(-2/3): depth = a s^2 - C s^3, V = 2/5 a s^5 - C s^6 / 2.
class HertzSpring {
public:
    static constexpr double kSteepness = 10; ///< of the straight part, in 1/C

    HertzSpring() = default; ///< bears nothing
    /// @param hertz       k [N/m^1.5], > 0
    /// @param compliance  C [m/N]; of a body that moves in a few modes, which yield less than a
    ///                    mesh, it may be negative: the rest of its yielding is in the spring then
    /// @param deepest     the curved part ends here if not before [m]: half-spaces end too
    HertzSpring(double hertz, double compliance, double deepest) noexcept
        : a_(1 / std::cbrt(hertz * hertz)), c_(compliance) {
        if (compliance > 0) {
            // dF/d(depth) = 3 s / (2 a - 3 C s) reaches steep_ where
            steep_ = kSteepness / compliance;
            end_s_ = 2 * a_ * steep_ / (3 * (1 + c_ * steep_));
        }
        if (!(compliance > 0) || curved_depth(end_s_) > deepest)
            end_s_ = root(deepest);
        if (!(compliance > 0))
            steep_ = 3 * end_s_ / (2 * a_ - 3 * c_ * end_s_);
        end_depth_ = curved_depth(end_s_);
        end_force_ = end_s_ * end_s_ * end_s_;
        end_energy_ = curved_energy(end_s_);
    }

    double force(double depth) const noexcept {
        if (depth <= 0)
            return 0;
        if (depth >= end_depth_)
            return end_force_ + steep_ * (depth - end_depth_);
        const double s = root(depth);
        return s * s * s;
    }
    double energy(double depth) const noexcept { ///< [J]
        if (depth <= 0)
            return 0;
        if (depth >= end_depth_) {
            const double more = depth - end_depth_;
            return end_energy_ + (end_force_ + steep_ * more / 2) * more;
        }
        return curved_energy(root(depth));
    }
    /// Of all that gives way, the share that this spring is; the rest is the mesh's.
    double own_share(double depth) const noexcept {
        if (depth <= 0)
            return 0;
        return depth / (depth + c_ * std::fmin(force(depth), end_force_));
    }
    double end_depth() const noexcept { return end_depth_; } ///< of the curved part [m]
    double end_force() const noexcept { return end_force_; } ///< there [N]
    double steep() const noexcept { return steep_; }         ///< largest stiffness [N/m]

    /// The conserving force between depths a, one substep ago, and b, one ahead: see
    /// conserving_spring.h, of which this is the case of another potential.
    /// @param g, a, b0  as there.
    double press(double g, double a, double b0) const noexcept {
        if (a <= 0 && b0 <= 0)
            return 0;
        const double before = energy(a);
        if (g == 0)
            return std::fabs(b0 - a) < 1e-9 * std::fabs(a) ? force(b0)
                                                           : (energy(b0) - before) / (b0 - a);
        // F falls as b falls: the root lies between b0 and b0 - g F(max(a, b0)).
        double high = b0;
        double low = b0 - g * force(std::fmax(a, b0));
        double b = std::fmin(std::fmax(b0, low), high);
        double mean = 0;
        for (int i = 0; i < kMostIterations; ++i) {
            const double step = b - a;
            const double at_b = force(b);
            // Where nothing moves the mean is the force, its slope half the stiffness.
            const bool still = std::fabs(step) < 1e-9 * std::fabs(a);
            mean = still ? at_b : (energy(b) - before) / step;
            const double slope = still ? steep_ / 2 : (at_b - mean) / step;
            const double miss = b - b0 + g * mean;
            (miss > 0 ? high : low) = b;
            const double next = b - miss / (1 + g * std::fmax(0.0, slope));
            const double to = next > low && next < high ? next : (low + high) / 2;
            const bool done = std::fabs(to - b) <= 1e-13 * std::fmax(std::fabs(a), std::fabs(b));
            b = to;
            if (done)
                break;
        }
        return std::fmax(0.0, (b0 - b) / g);
    }

private:
    static constexpr int kMostIterations = 60;

    double curved_depth(double s) const noexcept { return (a_ - c_ * s) * s * s; }
    double curved_energy(double s) const noexcept {
        const double s2 = s * s;
        return (0.4 * a_ - 0.5 * c_ * s) * s2 * s2 * s;
    }
    /// s of a depth on the curved part, by Newton from below, where the slope falls.
    double root(double depth) const noexcept {
        double s = std::sqrt(depth / a_);
        for (int i = 0; i < kMostIterations; ++i) {
            const double change = (curved_depth(s) - depth) / ((2 * a_ - 3 * c_ * s) * s);
            s -= change;
            if (std::fabs(change) <= 1e-14 * s)
                break;
        }
        return s;
    }

    double a_ = 1;
    double c_ = 0;
    double steep_ = 0;
    double end_s_ = 0;
    double end_depth_ = 0;
    double end_force_ = 0;
    double end_energy_ = 0;
};

} // namespace ode::soft
