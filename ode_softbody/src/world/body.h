#pragma once

#include "base/live_id.h"
#include "collide/soft_geom.h"
#include "couple/node_contact.h"
#include "couple/node_forces.h"
#include "couple/soft_surface.h"
#include "couple/soft_volume.h"
#include "integrate/integrator.h"
#include "mesh/curve.h"
#include "mesh/surface.h"
#include "mesh/tet_mesh.h"
#include "modal/modal_damping.h"
#include "model/elastic_model.h"
#include "model/solid.h"
#include "world/body_form.h"
#include "world/energy_budget.h"
#include "world/modal_tier.h"
#include "world/rest_limits.h"
#include "world/rigid_pairs.h"
#include "world/tier.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ode::soft {

class SoftWorld;
struct ModalOptions;

/// A soft body: a meshed solid, its motion, its surface and its geom in ODE's space.
/// Node arrays are world frame, in the mesh's order.
class Body final : private SoftGeomClient {
public:
    /// At rest in the mesh's own coordinates, with a geom in the world's space; in elements of the
    /// mesh's order.
    /// @param solids  one a group of the mesh, or one for all of it.
    /// @throws InputError for a mesh or solids that no body can be made of.
    Body(SoftWorld& world, const TetMesh& mesh, std::span<const Solid> solids);
    Body(SoftWorld& world, const TetMesh& mesh, const Solid& solid)
        : Body(world, mesh, {&solid, 1}) {}
    ~Body();
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

    /// nullptr for a geom that is no soft body's.
    static Body* behind(dGeomID geom) noexcept;

    SoftWorld& world() const noexcept { return world_; }
    /// Of the body's order: the nodes of the mesh it was made of come first, under their indices.
    const TetMesh& mesh() const noexcept { return mesh_; }
    const Surface& surface() const noexcept { return surface_; }
    const std::vector<Solid>& solids() const noexcept { return solids_; } ///< by mesh().group
    const ElasticModel& model() const noexcept { return *model_; }
    dGeomID geom() const noexcept { return geom_; } ///< nullptr once the application destroyed it

    const BodyForm& form() const noexcept { return form_; }
    int given_order() const noexcept { return given_order_; } ///< of the mesh it was made of
    /// Solves the body as something else from now on. Its nodes stay where they are, with their
    /// velocities, forces and pins; new ones follow the motion of their element. The substep
    /// becomes the default.
    /// @return of curve_surface(), when form.curved.
    /// @throws InputError and changes nothing when the body has been stepped or cannot be had in
    ///         this form.
    CurveReport set_form(const BodyForm& form);

    /// A rigid geom is near in this step.
    void note_pair(dGeomID other) noexcept { on_pair(other); }

    /// Brought up to date first where the body moves in modes.
    const NodeState& state() const noexcept {
        if (modes_ && modes_->stale())
            modes_->refresh();
        return state_;
    }
    std::span<const double> mass() const noexcept { return model_->mass(); } ///< of each node [kg]

    double total_mass() const noexcept { return total_mass_; } ///< [kg]
    Vec3 center_of_mass() const noexcept;                      ///< [m]
    Vec3 linear_momentum() const noexcept;                     ///< [kg m/s]
    Vec3 angular_momentum() const noexcept;                    ///< about the origin [kg m^2/s]
    double kinetic_energy() const noexcept;                    ///< [J]
    double elastic_energy() const noexcept;                    ///< [J]

    void move_to(const Vec3& center) noexcept;
    void rotate(const Quat& rotation) noexcept; ///< about the centre of mass
    void set_velocity(const Vec3& velocity) noexcept;
    void add_spin(const Vec3& omega) noexcept; ///< about the centre of mass [rad/s]

    /// Holds nodes where they are, at zero velocity; an edge added by promotion is held at its
    /// middle when it is at both ends, or a clamped face would leak.
    void pin(std::span<const int> nodes) noexcept;
    void unpin() noexcept;
    std::span<const int> pinned() const noexcept { return pinned_; } ///< ascending

    /// Whether modes damp the body: asked for, or the only way to a loss factor or a table.
    bool damped_by_modes() const noexcept { return damped_by_modes_; }
    bool has_loss_factor() const noexcept; ///< of any of its solids

    /// Adds to the forces of the next step [N].
    void add_force(int node, const Vec3& force) noexcept;

    /// Of the integrator, at rest [s]. 0: undamped modes grow at any step; infinite: at none.
    double critical_step() const noexcept { return critical_step_; }
    /// Longest that is taken [s]: the critical one, where there is one.
    double longest_substep() const noexcept { return longest_substep_; }
    double substep() const noexcept { return substep_; } ///< asked for [s]
    /// What contact laws take for it: stiffness must not change with what is in use [s].
    double contact_substep() const noexcept { return std::min(substep_, longest_substep_); }
    /// @param dt  0 < dt <= longest_substep(), or the body will be taken back before long.
    void set_substep(double dt) noexcept {
        substep_ = dt;
        caution_ = 1;
    }
    void use_default_substep() noexcept;
    /// critical_step() of the body as it stands now: stretch stiffens. Costs an assembly and about
    /// 75 products with the stiffness matrix; allocates.
    double present_critical_step() const;

    /// The same for observers, who look often: where the body moves in modes, momentum is right to
    /// some digits only.
    const NodeState& shown_state() const noexcept {
        if (modes_ && modes_->stale())
            modes_->place_all();
        return state_;
    }

    /// How its motion is to be computed, and how it is at present.
    TierChoice tier_choice() const noexcept { return tier_choice_; }
    void set_tier(TierChoice choice) noexcept;
    /// Where it rings: as long a substep as can be, unless its nodes are watched.
    void pace(bool watched) noexcept;
    /// Substep while contact is near, whose nodes come at the other side at `speed` [m/s], [s].
    double contact_pace(double speed) const noexcept;
    bool rings() const noexcept { return modes_ != nullptr; } ///< it moves in its modes
    bool bends() const noexcept { return modes_ && modes_->motion().cubic(); } ///< non-linearly
    /// nullptr while it doesn't.
    const ModalMotion* modal_motion() const noexcept {
        return modes_ ? &modes_->motion() : nullptr;
    }
    unsigned long tier_changes() const noexcept { return tier_changes_; }
    /// Of the linear tier's waveform, as last estimated, relative; infinite before.
    double linear_error() const noexcept { return linear_error_; }
    double cubic_error() const noexcept { return cubic_error_; } ///< the same of the cubic tier's
    double waveform_tolerance() const noexcept { return waveform_tolerance_; }
    void set_waveform_tolerance(double relative) noexcept { waveform_tolerance_ = relative; }

    const ContactLaw& contact_law() const noexcept { return contact_law_; }
    void set_contact_law(const ContactLaw& law) noexcept { contact_law_ = law; }
    bool self_contact() const noexcept { return self_contact_; }
    void set_self_contact(bool on) noexcept { self_contact_ = on; }

    bool stopped() const noexcept { return stopped_; }
    /// At rest: kept as it is, and left out of everything, until it is woken.
    bool asleep() const noexcept { return asleep_; }
    bool moves() const noexcept { return !stopped_ && !asleep_; }
    bool auto_disable() const noexcept { return auto_disable_; }
    void set_auto_disable(bool on) noexcept { auto_disable_ = on; }
    const RestLimits& rest_limits() const noexcept { return rest_limits_; }
    void set_rest_limits(const RestLimits& limits) noexcept { rest_limits_ = limits; }
    void wake() noexcept;
    void fall_asleep() noexcept;
    bool has_come_to_rest() const noexcept { ///< and would sleep
        return auto_disable_ && quiet_ >= rest_limits_.time && nailed_.empty();
    }
    bool is_nailed() const noexcept { return !nailed_.empty(); }
    const StrainExtremes& extremes() const noexcept { return extremes_; } ///< of the last step
    /// Substep that is stable at the stretch lately met, and after what went wrong lately [s].
    double safe_substep() const noexcept;
    /// Its energy and what is due of it, at the last look: see EnergyBudget.
    const EnergyBudget& budget() const noexcept { return budget_; }
    /// Times that the body was taken back to the start of a step because it went unstable.
    int rollbacks() const noexcept { return rollbacks_; }
    int failed_solves() const noexcept { return failed_solves_; } ///< of an implicit integrator
    std::size_t bearing_points() const noexcept { return bearing_points_; }
    /// What a substep takes without contacts, in force evaluations of a linear element: 10 ns.
    std::size_t substep_work() const noexcept;
    double cost() const noexcept; ///< of it, in seconds a second simulated, as it moves now

    void* data = nullptr; ///< the application's
    void* id() const noexcept { return id_.value(); }

private:
    friend class SoftWorld;
    friend class Attachments;
    friend class RigidExchange;
    friend class SoftExchange;
    friend class Slumber;
    friend class ModalTier;

    /// Takes over a mesh that has the nodes of the body's own first. @throws InputError
    void build(TetMesh mesh, const BodyForm& form, bool damped_by_modes);
    std::vector<Solid> stress_solids(bool damped_by_modes) const; ///< as the model damps them
    double critical_step_at(const IntegratorKind& method, std::span<const Solid> solids,
                            double frequency) const;
    void hold(int node) noexcept;
    bool is_held(int node) const noexcept { ///< pinned or nailed
        return inverse_mass_[static_cast<std::size_t>(node)] == 0;
    }
    bool is_pinned(int node) const noexcept {
        return std::binary_search(pinned_.begin(), pinned_.end(), node);
    }
    /// For each edge of each element that promotion gave a node: visit(end, end, middle).
    template <class Visit>
    void each_middle(Visit visit) const;
    /// Takes free nodes, and the middles of edges between them, out of the body's own motion:
    /// somebody else moves them until release(). @return which.
    std::vector<int> nail(std::span<const int> nodes);
    void release(int node) noexcept;
    void set_nailed_mass(bool own) noexcept; ///< their own, or infinite as in substeps

    Aabb aabb() noexcept override;
    void on_pair(dGeomID other) noexcept override;
    int on_ray(dGeomID ray, int flags, dContactGeom* contact, int skip) noexcept override;
    void on_destroyed() noexcept override;

    /// Remembers the state to return to; weight and external forces become those of this step.
    void begin_step(const Vec3& gravity) noexcept;
    void find_damped_modes() noexcept; ///< of the body as it is held now
    /// Brings the velocity to half of `dt` before the positions' time, where the integrator keeps
    /// it.
    void fit_velocity(double dt) noexcept;
    void take_load(const Vec3& gravity) noexcept;

    // body_modes.cpp
    bool may_ring() noexcept; ///< modes can be had
    bool may_bend() noexcept; ///< and what isn't linear of them
    ModalOptions modal_options() const;
    std::shared_ptr<const ModalBasis> find_basis() noexcept;
    std::shared_ptr<const CubicTerms> find_cubic() noexcept;

    // body_tier.cpp
    void choose_tier() noexcept;
    void choose_in_modes(double blow) noexcept; ///< automatically, in modes
    /// Closing speed of the fastest contact that so many steps may bring [m/s].
    double blow_ahead(double steps) noexcept;
    /// Whether such a blow may be taken in modes, and as it needs.
    bool bears_in_modes(double blow, ModalTier& modes, bool cubic) noexcept;
    double linear_error_of(double displacement) const noexcept; ///< [m]
    double cubic_error_of(double displacement) const noexcept;
    /// Which modes contact moves. @param blow  what may come within the step [m/s].
    void choose_band(double blow) noexcept;
    void set_band(std::size_t columns) noexcept;
    void level_velocity() noexcept; ///< brings it to the positions' time
    void enter_modes(bool bends) noexcept;
    void leave_modes() noexcept;  ///< the nodes take over
    void forget_modes() noexcept; ///< supports have changed
    void bend(bool on) noexcept;  ///< in modes: with what isn't linear, or without
    void estimate_errors(ModalTier& modes) noexcept;
    void begin_ringing_step(const Vec3& gravity) noexcept;
    void advance_ringing(double dt) noexcept;
    /// Inverse of the mass that contact meets at each mesh node [1/kg]; 0: held.
    std::span<const double> contact_inverse_mass() const noexcept {
        return modes_ ? modes_->inverse_mass() : std::span<const double>(inverse_mass_);
    }
    /// force_ becomes all that acts but contact. @param look  whether this substep is looked at.
    void begin_substep(bool look) noexcept;
    void advance(double dt) noexcept; ///< by force_
    /// Before advance(), with all force known. @param passed  since the last look [s].
    void watch_rest(double passed) noexcept;
    void damp(double dt) noexcept;
    void note(const StrainExtremes& now) noexcept;
    void end_step() noexcept;

    // body_stability.cpp
    void reset_watch(const std::string& law, double frequency) noexcept;
    bool is_free() const noexcept { return pinned_.empty() && nailed_.empty(); }
    double moving_energy(const MotionSums& sum) const noexcept; ///< seen from where it is looked at
    double load_seen(const MotionSums& sum) const noexcept;     ///< load . x, from there [J]
    double load_now() const noexcept;
    double nailed_energy() const noexcept; ///< kinetic [J]
    /// What is known of contacts before the body moves, and after.
    double contact_work(double dt) const noexcept;
    void book_contacts(double before, double dt) noexcept;
    /// The velocity is about to lag half of dt: contacts that fit_velocity() leaves out push for
    /// that much longer or shorter.
    void book_lag(double dt) noexcept;
    void finish_look(double dt) noexcept;
    bool is_given_up() const noexcept { return given_up_; }
    bool was_looked_at() const noexcept { return looking_; }
    bool is_sound() const noexcept; ///< as far as it was looked at
    /// Takes measures after the body was found unsound. @return false: there are none left, and it
    /// is given up.
    bool take_care() noexcept;
    /// Makes room for the stretch met in this step. @return whether that took a shorter substep.
    bool adapt_margin() noexcept;
    void relax_margin() noexcept; ///< the way back, when it has long not been needed
    void roll_back() noexcept;
    void stop() noexcept;
    void watch_inversion() noexcept;
    std::string trouble() const; ///< what is not sound
    void moved() noexcept;       ///< tells ODE that the geom's box is out of date
    double max_speed() const noexcept;

    SoftWorld& world_;
    TetMesh mesh_;
    std::size_t given_nodes_; ///< of the mesh that the body was made of, first in mesh_
    int given_order_;
    std::vector<Solid> solids_;
    BodyForm form_;
    Surface surface_;
    std::unique_ptr<ElasticModel> model_;
    std::unique_ptr<Integrator> integrator_;
    bool is_explicit_ = true; ///< the integrator
    bool lags_ = true;        ///< its velocity is that of half a substep ago
    NodeState state_;
    struct Checkpoint { ///< at the start of the step, to return to when the step fails
        NodeState state;
        double last_dt = 0;
        double undamped = 0;
        double modal_pending = 0;
        double quiet = 0;
        EnergyBudget budget;
    };
    Checkpoint checkpoint_;
    NodeArray force_;    ///< [N]
    NodeArray external_; ///< the application's, constant over a step [N]
    NodeArray load_;     ///< gravity and external_ [N]
    bool has_external_ = false;
    std::vector<double> alpha_; ///< mass-proportional damping, one for all or one a node [1/s]
    double max_alpha_;
    bool damped_by_modes_ = false;
    bool modes_stale_ = false; ///< modal_damping_ is of other supports, or none yet
    std::unique_ptr<ModalDamping> modal_damping_;
    std::vector<double> inverse_mass_; ///< [1/kg], 0: held
    std::vector<int> pinned_;
    std::vector<int> nailed_;
    SurfaceNodes contact_nodes_; ///< area, mass, neighbourhood of each surface node
    ContactLaw contact_law_;
    bool self_contact_ = false;
    unsigned long number_ = 0; ///< bodies of the world made before
    double total_mass_;
    double critical_step_;
    double longest_substep_;
    double substep_;
    double undamped_ = 0; ///< time since mass-proportional damping was last applied [s]
    double last_dt_ = 0;  ///< that the velocity lags half of; 0 before the first step [s]
    double margin_ = 1;   ///< the substep is shortened by, for stretch
    double caution_ = 1;  ///< the substep is shortened by, for what went wrong
    int calm_steps_ = 0;  ///< steps in a row that would have done with less margin
    int quiet_steps_ = 0; ///< steps in a row in which nothing went wrong
    EnergyBudget budget_;
    ContactShare contacts_; ///< of the last substep
    /// Some of them with what moves and doesn't shift its velocity when substeps change: momentum
    /// comes first, and this body's isn't shifted for them either.
    bool meets_movable_ = false;
    MotionSums before_;       ///< of the substep looked at
    Vec3 frame_velocity_;     ///< from which energy is looked at [m/s]
    Vec3 total_load_;         ///< [N]
    double elastic_ = 0;      ///< energy at the last evaluation [J]
    double load_at_look_ = 0; ///< load_seen() [J]
    double swing_ = EnergyBudget::kLeast;
    double noise_ = 0;             ///< energy that rounding makes [J]
    double elastic_noise_ = 0;     ///< of it, by the law's cancellation [J]
    double largest_frequency_ = 0; ///< at rest [rad/s]
    bool looking_ = false;
    bool in_budget_ = true;
    bool given_up_ = false;
    bool failed_solve_ = false; ///< in this step
    bool inverted_ = false;     ///< some element is, and it was told
    int rollbacks_ = 0;
    int failed_solves_ = 0;
    StrainExtremes extremes_;
    std::size_t bearing_points_ = 0;
    bool stepped_ = false;
    bool stopped_ = false;
    bool asleep_ = false;
    bool auto_disable_ = false;
    RestLimits rest_limits_;
    std::size_t place_ = 0; ///< among the world's bodies; Slumber's
    double quiet_ = 0;      ///< within rest_limits_ for so long [s]
    TierChoice tier_choice_ = TierChoice::explicit_space;
    std::unique_ptr<ModalTier> modes_;      ///< while it moves in them
    std::unique_ptr<ModalTier> idle_modes_; ///< while it doesn't, once it did
    bool modes_known_ = false;              ///< asked for since supports last changed
    bool cubic_known_ = false;              ///< the same of what isn't linear of them
    unsigned long tier_changes_ = 0;
    double waveform_tolerance_ = 0.025; ///< of modes against nodes: see linear_error_of()
    double linear_error_ = std::numeric_limits<double>::infinity();
    double cubic_error_ = std::numeric_limits<double>::infinity();
    double thickness_ = 0;  ///< twice volume over surface [m]
    double gentle_for_ = 0; ///< no blow [s]
    double sampled_at_ = 0; ///< displacement at which the error was last estimated [m]
    int unsampled_ = 0;     ///< steps since then
    std::unique_ptr<SoftSurface> soft_surface_; ///< made when it first meets a soft body
    std::unique_ptr<SoftVolume> soft_volume_;   ///< the same, under the volume penalty
    std::vector<dGeomID> pair_;                 ///< geoms near in this step
    std::vector<RigidPair> rigid_pair_;         ///< those of them that bear contact in this step
    dGeomID geom_ = nullptr;
    LiveId<Body> id_{*this};
};

} // namespace ode::soft
