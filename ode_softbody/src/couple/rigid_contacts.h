#pragma once

#include "couple/rigid_shadow.h"

#include <ode/contact.h>

#include <cstddef>
#include <span>
#include <vector>

namespace ode::soft {

/// Contacts between the rigid bodies of a pile, and of these with the ground, during the substeps:
/// persistent springs and dashpots where ODE has rigid contact joints that last for a step.
///
/// Normal: a one-sided spring that keeps energy (NormalContact) of 1e7 N/m, or of what the
/// application's soft_erp and soft_cfm say, and a dashpot that gives the restitution asked for
/// (none, if the contact doesn't bounce). Friction by a spring with a clamped stretch, as in
/// NodeContact; mu by Coulomb under dContactApprox1, else a force, as in ODE. Surface motion along
/// fdir1 counts. mu2, slip and rolling friction don't.
///
/// A contact bears nothing at first sight: ODE reports it up to a step late, so deep that a spring
/// would eject the pile. The depth found is its offset, which fades at 4 /s within the substeps. In
/// later steps it is known by place (8 mm), and its compression goes on from where it was.
class RigidContacts {
public:
    void begin_step() noexcept;
    void keep() { kept_ = point_; } ///< as NodeContact's
    void take_back() noexcept { point_.swap(kept_); }
    /// A contact of this step. @param first, second  shadows by index; the normal points to first.
    void meet(const dContact& contact, std::size_t first, std::size_t second,
              std::span<const RigidShadow> shadow, double h, double dt);
    /// Forgets those that this step hasn't got, but for the grazing, which ODE may miss.
    /// @param index_of  shadow of a body, or a negative number.
    template <class IndexOf>
    void end_meeting(IndexOf index_of, std::span<const RigidShadow> shadow) {
        std::erase_if(point_, [&](Point& point) {
            if (point.seen)
                return false;
            const auto first = index_of(point.body[0]);
            const auto second = index_of(point.body[1]);
            if (first < 0 || second < 0)
                return true;
            point.shadow[0] = static_cast<std::size_t>(first);
            point.shadow[1] = static_cast<std::size_t>(second);
            return !is_grazing(point, shadow);
        });
    }

    /// A substep, to be followed by sweeps over the normal forces and by friction.
    void begin_substep(std::span<RigidShadow> shadow, double dt) noexcept;
    /// Brings each normal force in line with all else that acts on the shadows by now.
    /// @return the sum of changes, of the sum of forces.
    double sweep(std::span<RigidShadow> shadow, double dt) noexcept;
    /// @return how many bear.
    std::size_t drag(std::span<RigidShadow> shadow, double dt) noexcept;

    std::size_t size() const noexcept { return point_.size(); }

private:
    struct Point {
        dBodyID body[2];       ///< nullptr: the ground
        std::size_t shadow[2]; ///< of this step
        Vec3 local[2];         ///< the point, fixed to each body [m]
        Vec3 normal;           ///< to the first, world
        double found;          ///< depth when it was met [m]
        double offset;         ///< depth at which it bears nothing [m]
        Vec3 stretch;          ///< of the friction spring, world [m]
        double stiffness;      ///< [N/m]
        double damping;        ///< [N s/m]
        double friction;       ///< Coulomb's, or a force [N]
        bool coulomb;
        Vec3 drive; ///< surface velocity of the first against the second [m/s]
        bool seen;
        // Of the substep:
        Vec3 place;        ///< world [m]
        Vec3 slip;         ///< of the first against the second, half a substep ago [m/s]
        double depth;      ///< [m]
        double compliance; ///< [1/kg]
        double press = 0;  ///< so far [N]
    };

    static double depth_of(const Point& point, std::span<const RigidShadow> shadow) noexcept;
    static bool is_grazing(const Point& point, std::span<const RigidShadow> shadow) noexcept;
    static Vec3 place_of(const Point& point, std::span<const RigidShadow> shadow) noexcept;
    static void apply(const Point& point, const Vec3& f, std::span<RigidShadow> shadow) noexcept;
    Point* find(const Point& fresh, std::span<const RigidShadow> shadow) noexcept;

    std::vector<Point> point_, kept_;
};

} // namespace ode::soft
