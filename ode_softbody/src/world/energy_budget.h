#pragma once

#include "couple/node_forces.h"
#include "integrate/node_state.h"

#include <algorithm>
#include <span>

namespace ode::soft {

/// What is looked at of a body's motion.
struct MotionSums {
    double kinetic = 0;           ///< [J]
    Vec3 momentum = Vec3::Zero(); ///< [kg m/s]
    double load = 0;              ///< sum of load . x [J]
    Vec3 moment = Vec3::Zero();   ///< sum of m x [kg m]
};

/// Whether a body's energy is accounted for: kinetic and elastic, against what contacts, nails,
/// gravity and the application's forces have put in. Nodes that are held get nothing from what
/// holds them. A free body is looked at from its centre of mass, so that the energy of its flight
/// hides nothing; gravity then does no work.
///
/// The budget is the least energy that was found, and the work done since. A stable method brings
/// energy back only so far as it swings: see swing(). Explicit methods that are unstable multiply
/// energy by more than 1 a substep, so what creeps up a thousandth a look is no instability: the
/// budget follows, and errors of the books never add up.
class EnergyBudget {
public:
    /// Of the energy of central difference, whose velocity lags: a vibration of w h = 2 s, elastic
    /// energy at the time of the positions and the mean of kinetic energy before and after, is
    /// found between (1 - s^2) and (1 + s^2) times the energy of its amplitude.
    /// @param share  of the critical step, s.
    static double swing(double share) noexcept {
        const double square = share * share;
        return square < 1 ? std::clamp((1 + square) / (1 - square), kLeast, kMost) : kMost;
    }
    static constexpr double kLeast = 2; ///< whatever the method
    static constexpr double kMost = 10; ///< energy grown tenfold is an instability at any step

    /// The application has moved the body, or changed what holds it: whatever is found next is due.
    void restart() noexcept { known_ = false; }
    /// Of a load that stays the same, up to the positions' time [J].
    void add_past_work(double work) noexcept { budget_ += work; }
    /// Of contacts and nails, over the substep [J].
    void add_work(double work) noexcept {
        budget_ += work;
        work_ += work;
    }
    void begin_substep() noexcept { work_ = 0; }

    /// @param energy  found at the positions' time [J].
    /// @param share   of the substep's work that it contains already.
    /// @param noise   below, nothing is wrong [J].
    /// @return whether it is accounted for.
    bool look(double energy, double share, double swing, double noise) noexcept {
        energy_ = energy;
        const double ahead = (1 - share) * work_;
        if (!known_)
            budget_ = energy + ahead;
        known_ = true;
        const double due = std::max(budget_ - ahead, noise);
        if (!(energy <= swing * due))
            return false;
        budget_ = std::min(energy, due * (1 + kCreep)) + ahead;
        return true;
    }
    /// Whether a share of all energy, found at the end of the substep, is not too much already.
    bool allows(double kinetic, double swing, double noise) const noexcept {
        return kinetic <= swing * std::max(budget_, noise);
    }
    /// Whether so much elastic energy, found between looks, asks for one.
    bool is_suspicious(double elastic, double swing, double noise) const noexcept {
        return known_ && !(elastic <= swing * std::max(budget_, noise));
    }

    double energy() const noexcept { return energy_; } ///< at the last look [J]
    double budget() const noexcept { return budget_; } ///< now [J]

private:
    static constexpr double kCreep = 1e-3; ///< a look

    double budget_ = 0;
    double work_ = 0; ///< of this substep
    double energy_ = 0;
    bool known_ = false;
};

/// The first two. Done in ranges like the substep, by who has the nodes in his cache: the look is
/// every tenth substep. Ranges depend on the number of nodes alone, and so do sums.
MotionSums kinetic_sums(std::span<const double> mass, const NodeArray& velocity) noexcept;

/// Of a load that stays the same [N].
void add_load_sums(std::span<const double> mass, const NodeArray& position, const NodeArray& load,
                   MotionSums& sum) noexcept;

} // namespace ode::soft
