#pragma once

#include "couple/node_contact.h"
#include "couple/rigid_shadow.h"

#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

class Body;

/// Everything between soft and rigid bodies during one ODE step: which contacts there are, and the
/// shadow of each rigid body that takes part, shared by all soft bodies that touch it.
///
/// Contacts outlive the step while their pair stays near, for friction's memory; shadows don't.
class RigidExchange {
public:
    /// Snapshots the shapes that the bodies have met. @param dt  substep [s].
    void begin_step(std::span<const std::unique_ptr<Body>> bodies, double h, double dt);

    /// Adds contact forces to the bodies' forces and their reactions to the shadows.
    ContactTally add_forces(double dt) noexcept;

    /// Moves the shadows on.
    void advance(double dt) noexcept;

    void hand_over() noexcept;  ///< before ODE's step
    void write_back() noexcept; ///< after ODE's step

    /// A soft body or a rigid geom is going.
    void forget(const Body& body) noexcept;

    /// The shadow of a rigid body in this step; the index is good for the step.
    std::size_t shadow_of(dBodyID body, double h, double dt);
    RigidShadow& shadow(std::size_t i) noexcept { return shadow_[i]; }
    const RigidShadow& shadow(std::size_t i) const noexcept { return shadow_[i]; }

private:
    struct Contact {
        Body* body;
        std::unique_ptr<NodeContact> law;
        std::size_t shadow;  ///< index into shadow_
        bool current = true; ///< met in this step
    };

    Contact& contact_of(Body& body, dGeomID geom);

    std::vector<Contact> contact_;
    std::vector<RigidShadow> shadow_;
};

} // namespace ode::soft
