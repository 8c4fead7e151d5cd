#pragma once

#include "couple/node_contact.h"
#include "couple/rigid_contacts.h"
#include "couple/rigid_response.h"
#include "couple/rigid_shadow.h"
#include "world/observer.h"
#include "world/rigid_islands.h"

#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

class Body;

/// Everything between soft and rigid bodies during one ODE step: which contacts there are, the
/// islands of rigid bodies that take part, and the shadow of each of their bodies, shared by all
/// soft bodies that touch it. A free body is an island of its own and needs its shadow alone;
/// jointed bodies have a twin in the mirror; piles have their contacts here.
///
/// The application's bodies move as under ODE alone until their island is touched; from then on as
/// the substeps say, until it has not been near for a tenth of a second: a bounce shall not begin
/// or end on ODE's coarser path.
///
/// Contacts outlive the step while their pair stays near, for friction's memory.
class RigidExchange {
public:
    /// Snapshots the shapes that the bodies have met. @param dt  substep [s].
    void begin_step(dWorldID world, std::span<const std::unique_ptr<Body>> bodies, double h,
                    double dt);

    /// Whether pushes() are wanted in this step: else none are noted.
    void watch_pushes(bool on) noexcept { watched_ = on; }
    /// What soft bodies did to rigid ones in this substep: each place on its own.
    std::span<const PushView> pushes() const noexcept { return push_; }
    void note_push(const Body& soft, std::size_t shadow, const RigidPush& push);

    /// Adds contact forces to the bodies' forces and their reactions to the shadows.
    ContactTally add_forces(double dt) noexcept;

    /// Before a substep: looks for what may touch bodies that ring, and slows their pace while
    /// something may. @param first  of a step
    void look_ahead(bool first) noexcept;

    /// Moves the shadows on.
    void advance(double dt) noexcept;

    void hand_over() noexcept;  ///< before ODE's step
    void write_back() noexcept; ///< after ODE's step

    /// A soft body is going.
    void forget(const Body& body) noexcept;

    /// The shadow of a rigid body in this step; the index is good for the step.
    std::size_t shadow_of(dBodyID body, double h, double dt);
    RigidShadow& shadow(std::size_t i) noexcept { return shadow_[i]; }
    const RigidShadow& shadow(std::size_t i) const noexcept { return shadow_[i]; }
    /// Before begin_step(): this body takes part, whoever touches it.
    void expect(dBodyID body) { lingering_.push_back(body); }
    /// Before begin_step(): this body exists and is awake. It may linger, near or not.
    void note_awake(dBodyID body);

    /// A contact joint has been made between rigid bodies.
    void note_contact(dJointID joint, const dContact& contact) { record_.note(joint, contact); }
    const dContact* find_contact(dJointID joint) const noexcept { return record_.find(joint); }

    /// The shadow of a body in this step, or nullptr.
    const RigidShadow* find_shadow(dBodyID body) const noexcept;
    const RigidIslands& islands() const noexcept { return islands_; } ///< of this step
    std::ptrdiff_t island_of(dBodyID body) const noexcept;            ///< -1: in none
    unsigned long mirror_steps() const noexcept { return mirror_.steps(); }
    /// Contacts between rigid bodies that bore force, summed over substeps.
    unsigned long rigid_contacts() const noexcept { return rigid_bearing_; }

private:
    struct Contact {
        Body* body;
        std::unique_ptr<NodeContact> law;
        std::size_t shadow;  ///< index into shadow_
        bool current = true; ///< met in this step
        int idle = 0;        ///< substeps since a body that rings was pushed or looked at
    };

    void lay_aside_sleepers();
    double sweep(double dt) noexcept;
    static TouchForces forces_on(Body& body, double dt) noexcept;
    void gather_islands(dWorldID world, std::span<const std::unique_ptr<Body>> bodies, double h,
                        double dt);
    void meet_rigid(double h, double dt);
    std::ptrdiff_t index_of(dBodyID body) const noexcept; ///< -1: none
    Contact& contact_of(Body& body, dGeomID geom);
    void note_pushes(const Contact& contact) noexcept;
    void wake_touched() noexcept;
    void enliven_touched() noexcept;

    double h_ = 0; ///< of this step [s]
    std::vector<Contact> contact_;
    std::vector<Contact> dormant_; ///< of soft bodies at rest, for friction's memory
    std::vector<RigidShadow> shadow_;
    std::vector<RigidShadow> before_;     ///< of the step before
    std::vector<RigidResponse> response_; ///< parallel to shadow_
    bool stepped_ = true;                 ///< write_back() has followed begin_step()
    std::vector<dBodyID> lingering_;
    RigidIslands islands_;
    MirrorWorld mirror_;
    RigidContacts rigid_;
    ContactRecord record_;
    unsigned long rigid_bearing_ = 0;
    bool watched_ = false;
    std::vector<PushView> push_;
    std::vector<RigidPush> felt_; ///< scratch
};

} // namespace ode::soft
