#pragma once

#include "collide/rigid_pose.h"
#include "couple/rigid_push.h"

#include <ode/common.h>

#include <span>

namespace ode::soft {

class Body;
class SoftWorld;

/// What a soft body did to a rigid one in a substep, at one place.
struct PushView {
    dBodyID rigid;
    const Body* soft;
    Pose pose; ///< of the rigid body, as the substep began
    RigidPush push;
};

/// One body at the end of a substep; borrowed, dies on return. Times only grow, and each view
/// begins where the last one ended: when a step is redone because a body went unstable, what was
/// shown of it is not shown again, and the views go on from there with the motion of the new
/// attempt.
struct SubstepView {
    const Body& body;
    double time; ///< [s] since the world's creation
    double dt;   ///< [s]
};

/// Watches a world's substeps. Observers run on the stepping thread, in order of registration, and
/// must not change the world, allocate or throw.
class Observer {
public:
    virtual ~Observer() = default;

    /// Whether on_substep() wants to be called; asked once a step, so that a world whose observers
    /// only watch steps hands out no views.
    virtual bool wants_substeps() const noexcept = 0;
    /// Whether a body that moves in its modes may be shown as such (Body::modal_motion()), with
    /// views that may be as far apart as a step: between two of them it rings undisturbed. Else its
    /// nodes are brought up to date for this observer, at the rate that audio asks for.
    virtual bool takes_modes() const noexcept { return false; }
    virtual void on_substep(const SubstepView& view) noexcept = 0;
    /// Whether on_pushes() wants to be called; asked once a step.
    virtual bool wants_pushes() const noexcept { return false; }
    /// Before the bodies are shown, where soft bodies pushed rigid ones in the substep that ends at
    /// `time` and took `dt` [s]. Borrowed.
    virtual void on_pushes(double /*time*/, double /*dt*/,
                           std::span<const PushView> /*pushes*/) noexcept {}
    /// After the substeps of a step, before ODE's own. @param time  at the step's end [s].
    virtual void on_step(SoftWorld& world, double time) noexcept = 0;
    /// After ODE's own step.
    virtual void on_moved(SoftWorld&, double) noexcept {}
    virtual void on_body_end(Body& body) noexcept = 0;
    virtual void on_world_end(SoftWorld& world) noexcept = 0;
};

} // namespace ode::soft
