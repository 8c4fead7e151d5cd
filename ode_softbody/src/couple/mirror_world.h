#pragma once

#include "couple/clone_joint.h"
#include "couple/twin_state.h"

#include <cstddef>
#include <span>
#include <vector>

namespace ode::soft {

/// A body with joints during the substeps: the application's, its twin, and what a contact must
/// know of it.
struct MirroredBody {
    dBodyID app;
    dBodyID twin;
    Wrench external; ///< the application's, constant over the step; gravity is the mirror's
    Wrench contact;  ///< of the substep to come
    /// Acceleration by a wrench, joints obeyed, in the body's frame [1/kg, ...]. Until it has been
    /// measured, that of the body without its joints.
    Mat6 mobility;
    Vec6 drift = Vec6::Zero(); ///< acceleration in the last substep but for contacts, world frame
    bool asked = false;        ///< a contact wants the mobility
    bool measured = false;
    bool dynamic = true;
    bool touched = false; ///< in this step
    bool borne = false;   ///< it, or one that it is joined to, in the last substep: see RigidShadow
    bool live = false;    ///< its island has been touched since it came near: the mirror rules
    bool propped = false; ///< its island has contacts between rigid bodies
    bool current = false; ///< near in this step
    bool known = false;   ///< written and inner are of the step before
    TwinState written;    ///< what the application was given
    TwinState inner;      ///< the twin's own at that moment
};

/// A private ODE world with twins of the jointed bodies near soft ones, stepped at the substep by
/// ODE's own dWorldStep: every kind of joint, limit and motor acts inside the step as it does
/// outside, at the cost of ODE's solver (1.6 us a hinge). No geoms, no callbacks, no
/// auto-disabling; nothing of it reaches the application's bodies before write_back().
///
/// Velocities: ODE's belong half a step back (see RigidShadow). A body that comes near gets its
/// velocity shifted by the acceleration that its joints leave it, found by two steps on trial; what
/// is written back is shifted the other way. As long as the application leaves a body as it was
/// written, the twin goes on from its own state, so that no shift matters; while a contact bears
/// it, or one that it is joined to, it is written as it moves.
///
/// Allocates when a body or joint comes near that wasn't there in the step before, and in the first
/// steps after (ODE's working memory, kept by the world). A step with the same ones allocates
/// nothing.
class MirrorWorld {
public:
    MirrorWorld() = default;
    ~MirrorWorld();
    MirrorWorld(const MirrorWorld&) = delete;
    MirrorWorld& operator=(const MirrorWorld&) = delete;

    /// A step begins. include() every jointed body that is near, then build().
    void begin_step(dWorldID app, double h, double dt) noexcept;
    void include(dBodyID app, bool propped);
    void build();

    bool empty() const noexcept { return body_.empty(); }
    MirroredBody* find(dBodyID app) noexcept; ///< good until the next include()
    std::span<MirroredBody> bodies() noexcept { return body_; }

    /// One substep, with the contacts of each body, which it then forgets. Measures the mobility
    /// first where it is asked for.
    void advance(double dt) noexcept;

    /// Live bodies of the application take their twins' state.
    void write_back() noexcept;

    unsigned long steps() const noexcept { return steps_; } ///< of the twins' world, since creation

private:
    struct Joint {
        dJointID app;
        dJointID twin;
        dBodyID first;
        dBodyID second;
        bool current;
    };

    dBodyID twin_of(dBodyID app);
    void drop_stale() noexcept;
    void mirror_joints();
    void refresh(MirroredBody& body) noexcept;
    void scale(double dt) noexcept;
    void save() noexcept;
    void restore() noexcept;
    void step(double dt) noexcept;
    void find_accelerations() noexcept; ///< fills acceleration_, contacts left out
    void measure_mobility() noexcept;
    void spread_borne() noexcept; ///< over joints
    bool is_awake() const noexcept;

    dWorldID app_ = nullptr;
    dWorldID world_ = nullptr;
    double h_ = 0;
    double dt_ = 0;
    unsigned long steps_ = 0;
    std::vector<MirroredBody> body_;
    std::vector<Joint> joint_;
    std::vector<TwinState> saved_;
    std::vector<Vec6> acceleration_;
};

/// ODE's dWorldStep, whoever interposes it.
int real_world_step(dWorldID world, dReal h) noexcept;

} // namespace ode::soft
