#pragma once

#include "couple/node_forces.h"
#include "integrate/node_state.h"
#include "reduced/cubic_kicks.h"
#include "reduced/modal_basis.h"
#include "reduced/mode_rows.h"
#include "reduced/oscillators.h"

#include <array>
#include <memory>
#include <optional>
#include <span>

namespace ode::soft {

/// A body as a frame that moves like a rigid body and small vibrations in it:
///
///     x = c + R (X + Phi q),   v = c' + w x (x - c) + R Phi q'.
struct ModalState {
    Vec3 center = Vec3::Zero();        ///< of mass; of a held body of its frame [m]
    Vec3 velocity = Vec3::Zero();      ///< [m/s]
    Quat turn = Quat::Identity();      ///< from the body's frame to the world's
    Vec3 spin_momentum = Vec3::Zero(); ///< angular momentum about the centre, world [kg m^2/s]
    AlignedVector<double> amplitude;   ///< q [kg^1/2 m]
    AlignedVector<double> rate;        ///< q' [kg^1/2 m/s]
};

/// The motion of a body in its modes, exact as far as it is linear.
///
/// The frame is the one in which vibrations carry no momentum to first order (a "mean axis" or
/// Buckens frame; J. R. Canavin and P. W. Likins, J. Spacecraft Rockets 14, 1977). Linear and
/// angular momentum are kept as such, so that nothing is lost between modes and nodes. A spin
/// stretches the body (centrifugal force on each mode) and mixes modes of like frequency
/// (gyroscopic coupling), which turns the pattern of a ringing bowl.
class ModalMotion {
public:
    explicit ModalMotion(std::shared_ptr<const ModalBasis> basis);

    const ModalBasis& basis() const noexcept { return *basis_; }
    const std::shared_ptr<const ModalBasis>& shared_basis() const noexcept { return basis_; }
    const ModalState& state() const noexcept { return state_; }

    /// What isn't linear, to be used from now on by use_cubic(true). Allocates.
    void set_cubic(std::shared_ptr<const CubicTerms> terms);
    bool has_cubic() const noexcept { return cubic_.has_value(); }
    /// Of set_cubic(), used or not; nullptr: none.
    const CubicTerms* cubic_terms() const noexcept { return cubic_ ? &cubic_->terms() : nullptr; }
    void use_cubic(bool on) noexcept;
    /// nullptr: it is linear at present.
    const CubicKicks* cubic() const noexcept { return bends_ ? &*cubic_ : nullptr; }
    CubicKicks* cubic() noexcept { return bends_ ? &*cubic_ : nullptr; }
    /// Brings the rates to this moment, which within an interval of kicks they aren't.
    void level() noexcept;

    void keep() noexcept;      ///< the state, for
    void take_back() noexcept; ///< coming back to it

    /// Takes over the motion of nodes whose velocity is that of the positions' time. What is in no
    /// mode is lost, momentum is not. @param held  nodes that tell the frame; none: all do.
    /// @return energy of what is lost, as if half of it were kinetic [J].
    double take(const NodeState& nodes, std::span<const int> held) noexcept;
    /// Puts all nodes where they are, with the velocities that have this momentum exactly.
    void give(NodeState& nodes) const noexcept;
    /// Some nodes, with the velocities that they have now.
    void place(std::span<const int> nodes, NodeState& out) const noexcept;

    /// Steady loads of the time to come. @param forces  on nodes, or null [N].
    void set_load(const Vec3& gravity, const NodeArray* forces) noexcept;
    /// Where it will be after dt [s] if nothing pushes it; good until advance().
    const ModalState& foresee(double dt) noexcept;
    /// Amplitude after dt for a unit of rate before, column by column [s].
    std::span<const double> drift(double dt) noexcept { return oscillators_.drift(dt); }
    /// How many modes pushes move, the first ones, whole lanes: all unless told otherwise.
    void set_band(std::size_t columns) noexcept { band_ = columns; }
    std::size_t band() const noexcept { return band_; }
    /// An impulse before advance(dt): each force for dt [s] at the nodes' place().
    void push(const ContactShare& forces, const NodeState& nodes, double dt) noexcept;
    void advance(double dt) noexcept;

    /// The modes that are in motion: all, those that gentle contact moves, or those that are heard,
    /// once what lies above has died away. The others are zero.
    std::size_t awake() const noexcept { return awake_; }
    std::span<const double> awake(const AlignedVector<double>& q) const noexcept {
        return std::span(q).first(awake_);
    }

    double vibration_energy() const noexcept; ///< [J]
    double rigid_energy() const noexcept;     ///< [J]
    /// Upper bounds over the body: of a node's displacement in the frame [m], of its speed [m/s].
    double largest_displacement() const noexcept;
    double largest_speed() const noexcept;
    /// What may come if nothing pushes it, at most, by all modes that are awake together: how far
    /// a node gets from where the frame carries it [m], how fast it is there [m/s].
    struct Swing {
        double way, speed;
    };
    /// @param way, acceleration  the same mode by mode: how far [kg^1/2 m], and how fast it is
    ///                           accelerated [kg^1/2 m/s^2].
    Swing swing(std::span<float> way, std::span<float> acceleration) const noexcept;
    /// How fast what the frame carries is accelerated, at most, if nothing pushes it [m/s^2].
    double frame_acceleration() const noexcept;
    /// Whether none of some nodes is faster at this moment, however they swing. What is pushed as
    /// it was in the last substep is taken in the middle of the push: what lies on a floor lies
    /// still.
    bool is_slower(double speed, std::span<const int> nodes) noexcept;
    /// Largest displacement of any of some nodes, as far as it swings: sqrt(u^2 + (u'/w)^2) [m].
    double displacement_envelope(std::span<const int> nodes) noexcept;
    Vec3 spin() const noexcept { return spin_of(state_.spin_momentum); } ///< world [rad/s]
    /// What an angular momentum amounts to [rad/s], both world.
    Vec3 spin_of(const Vec3& momentum) const noexcept;
    /// Inverse of the mass that a push at a node along a direction of the body's frame meets
    /// [1/kg].
    double inverse_mass(std::size_t node, const Vec3& direction) const noexcept;

    /// Amplitudes and rates of what is heard, in the order of cubic_terms()->sounding(), used or
    /// not, so that a change between the two is none of what is shown; else of the basis. Good
    /// until the motion goes on.
    struct Shown {
        const double *amplitude, *rate;
        std::size_t count;
    };
    Shown shown() const noexcept;

private:
    void fit_frame(const NodeArray& position, std::span<const int> held) noexcept;
    void turn_by(const Vec3& spin, double dt) noexcept;
    void move_on(double dt) noexcept;
    void fly(double dt) noexcept; ///< the frame
    /// Into settled_: where the first so many modes come to rest.
    void settle(std::size_t columns, const Vec3& spin) noexcept;
    void mix(const Vec3& spin, double dt) noexcept;
    int pieces(const Vec3& spin, double dt) const noexcept;
    void rest_what_died() noexcept;
    void copy(const ModalState& from, ModalState& to) const noexcept; ///< what is awake
    void begin_kicks(double dt) noexcept;                             ///< before a substep
    /// What follows the modes at once, to be spread over nodes; none if linear.
    struct Followers {
        Spread place, speed;
    };
    std::optional<Followers> followers() const noexcept;
    void find_following() const noexcept;

    std::shared_ptr<const ModalBasis> basis_;
    Oscillators oscillators_;
    ModalState state_;
    std::size_t awake_; ///< columns
    std::size_t band_;  ///< columns
    int unpruned_ = 0;  ///< advances since the modes above were last looked at
    ModalState kept_;   ///< by keep()
    std::size_t kept_awake_ = 0;
    ModalState ahead_;    ///< foreseen
    double foreseen_ = 0; ///< for so long; 0: not at all [s]
    Mat3 inverse_inertia_ = Mat3::Zero();
    Vec3 steady_force_ = Vec3::Zero();                   ///< on the whole body [N]
    Vec3 steady_torque_ = Vec3::Zero();                  ///< about its centre [N m]
    AlignedVector<double> load_;                         ///< on each mode, steady [N kg^-1/2]
    mutable std::array<AlignedVector<float>, 2> single_; ///< scratch: what is spread over nodes
    AlignedVector<double> impulse_;                      ///< of the last push(), on each mode
    Vec3 linear_impulse_ = Vec3::Zero();                 ///< the same on the whole body [N s]
    Vec3 angular_impulse_ = Vec3::Zero();                ///< about its centre [N m s]
    bool pushed_ = false;                                ///< in this substep
    bool was_pushed_ = false;                            ///< in the last
    AlignedVector<double> settled_; ///< scratch: where the modes would come to rest
    bool loaded_ = false;           ///< load_ isn't zero
    std::optional<CubicKicks> cubic_;
    bool bends_ = false; ///< by them
    struct Following {   ///< scratch
        AlignedVector<double> place, speed, shown_amplitude, shown_rate;
        AlignedVector<float> single_place, single_speed;
        CubicTerms::Work work;
    };
    mutable Following following_;
};

} // namespace ode::soft
