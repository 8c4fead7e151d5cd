#pragma once

#include "couple/contact_law.h"
#include "couple/free_motion.h"
#include "couple/mirror_world.h"

#include <ode/objects.h>

namespace ode::soft {

/// How a rigid body takes part in the substeps of one ODE step.
enum class RigidRole {
    fixed,      ///< static geometry without a body
    prescribed, ///< kinematic: moves by its velocities, whatever pushes it
    free,       ///< no joints: substepped here; ODE's result is overwritten
    mirrored,   ///< has joints: substepped as a twin in a MirrorWorld, which writes the result back
    unheard     ///< bears on rigid bodies by contacts that nobody recorded: substepped here as if
                ///< free; ODE gets the mean contact force and has the last word
};

/// A rigid body's state during the substeps of one ODE step, integrated beside the soft bodies with
/// the same leapfrog, so that what a contact gives to one side it takes from the other to rounding.
///
/// Velocities: ODE moves a body by its velocity at the end of a step, so what it stores belongs to
/// the middle of the step before. The shadow shifts it by the external force from there to half a
/// substep before the step's start, and back at the end. Thus, untouched, a free body moves as
/// under ODE alone, for any number of substeps (orientation: to the order of ODE's own error).
///
/// A body that a contact bears at the step's end may be at rest, which a shift by gravity alone
/// would show as g h / 2. It is written as it moves, and goes on from its own state as long as the
/// application leaves it as it was written. A pile's bodies (free, with recorded contacts between
/// rigid bodies) are `propped`: they enter as ODE left them.
///
/// `unheard` is a fallback and costs accuracy: within a step the other rigid bodies are not felt,
/// so a stack on a soft body rattles. It never gained energy in trials.
///
/// Per step: construct; per substep: add() any number of times, then advance() (and follow() once
/// the mirror has advanced); then hand_over(), ODE's real step, write_back().
class RigidShadow {
public:
    RigidShadow() = default; ///< fixed

    /// Reads body, world gravity, and the application's forces of the coming step.
    /// @param body  nullptr: fixed.
    /// @param h     length of the step [s].
    /// @param dt    first substep [s].
    RigidShadow(dBodyID body, double h, double dt) noexcept;

    /// Of a jointed body. @param twin  borrowed for the step.
    RigidShadow(MirroredBody& twin, double h) noexcept;

    /// Of the same body in the step before: how long to linger, what pressed on it when it fell
    /// asleep.
    void remember(const RigidShadow& before) noexcept;

    /// Of a body in a pile. @param before  its shadow in the step before, or nullptr.
    void prop(const RigidShadow* before) noexcept;

    dBodyID body() const noexcept { return body_; }
    RigidRole role() const noexcept { return role_; }
    const RigidMotion& motion() const noexcept { return motion_; }

    /// A contact force at a world point, until the next advance().
    void add(const Wrench& reaction) noexcept;

    /// Velocity of a point of the body after the kick to come, as far as it is known by now: with
    /// external forces and the contacts added so far [m/s].
    Vec3 velocity_ahead(const Vec3& world, double dt) const noexcept;

    /// What a force along a unit normal at a world point meets: 1/m + (r x n).I^-1.(r x n) [1/kg];
    /// 0 when the body can't be moved.
    double compliance(const Vec3& point, const Vec3& normal) const noexcept;

    /// Acceleration by a wrench, joints obeyed, world frame; zero when the body can't be moved.
    Mat6 mobility() const noexcept;
    /// Velocity and spin after the kick to come, as far as they are known by now.
    Vec6 twist_ahead(double dt) const noexcept;
    bool can_move() const noexcept { return inverse_mass_ != 0; }
    bool needs_books(double dt) const noexcept {
        return can_move() && EnergyBook::is_needed(motion_.spin, dt);
    }

    /// Announces friction of this substep before it acts. @param load  how much it asks of explicit
    /// stability: sum of (k dt^2 + 2 c dt) grip_compliance().
    /// @return factor on its stiffness and damping that a light body needs. It falls while contacts
    /// bear, which can only lose energy, and is 1 again after a substep without any.
    double soften(double load) noexcept;
    double softening() const noexcept { return softening_; }
    /// A contact that goes on carries its factor from step to step.
    void set_softening(double factor) noexcept { softening_ = factor; }
    /// The largest compliance() of a point across a normal [1/kg].
    double grip_compliance(const Vec3& point, const Vec3& normal) const noexcept;

    /// Kick by contact and external forces, then drift. A mirrored body's twin is told.
    void advance(double dt) noexcept;
    /// Takes the state of the twin, whose world has advanced.
    void follow() noexcept;

    /// Contact impulse and angular impulse about the moving centre since construction [N s, N m s].
    const Wrench& impulse() const noexcept { return impulse_; }
    bool touched() const noexcept { return touched_; } ///< by a soft body, in this step
    /// A contact with another rigid body: as add(), but none that ODE is told of.
    void add_from_rigid(const Wrench& reaction) noexcept;

    bool asleep() const noexcept { return asleep_; }
    /// A sleeping body whose island has been touched or holds an awake one.
    void wake() noexcept {
        asleep_ = false;
        if (role_ == RigidRole::mirrored)
            twin_->touched = true;
    }
    /// Asleep, and pressed otherwise than when it fell asleep.
    bool is_roused() const noexcept;
    /// Whether forces move it at present: it neither sleeps nor is prescribed or fixed.
    bool moves() const noexcept { return !asleep_ && inverse_mass_ != 0; }

    /// Whether its island has been touched since it came near, and ODE's result is overwritten.
    bool live() const noexcept { return live_; }
    double linger() const noexcept { return linger_; }
    /// @param linger  [s] that it shall stay so though it isn't near.
    void set_live(double linger) noexcept {
        live_ = true;
        linger_ = linger;
        if (twin_)
            twin_->live = true;
    }

    /// Before ODE's step: wakes a touched body and gives it the mean contact force.
    void hand_over() noexcept;
    /// After ODE's step: pose and velocities of a free body that was touched, or is live, become
    /// the shadow's.
    void write_back() noexcept;

private:
    void show_motion() noexcept; ///< motion_ becomes free_'s
    void take_impulse(double dt) noexcept;
    void end_substep() noexcept;
    Vec6 answer(const Wrench& contact) const noexcept; ///< mirrored: acceleration, world frame

    dBodyID body_ = nullptr;
    MirroredBody* twin_ = nullptr;
    RigidRole role_ = RigidRole::fixed;
    RigidMotion motion_;
    double h_ = 0;
    double inverse_mass_ = 0; ///< mirrored: 1, the mobility holds the true one
    FreeMotion free_;         ///< unless mirrored
    Quat orientation_ = Quat::Identity();
    Wrench external_;   ///< gravity and the application's
    Wrench contact_;    ///< of this substep
    Wrench from_rigid_; ///< of which by rigid bodies
    Wrench impulse_;
    double last_dt_ = 0;
    double load_ = 0;
    double softening_ = 1;
    bool asleep_ = false;
    bool touched_ = false;
    bool propped_ = false;
    bool has_rest_ = false;
    Wrench rest_;        ///< mean contact force when it fell asleep
    bool borne_ = false; ///< some contact bears in this substep
    bool bore_ = false;  ///< in the last
    bool live_ = false;
    double linger_ = 0;
    bool resumes_ = false; ///< goes on from the state of the step before
    TwinState written_;    ///< propped or borne: what the application's body was given
};

} // namespace ode::soft
