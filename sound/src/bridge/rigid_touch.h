#pragma once

#include "bridge/rigid_motion.h"
#include "bridge/rigid_recall.h"

#include <ode_softbody/softbody.h>

#include <deque>
#include <span>
#include <vector>

namespace ode::sound {

/// A contact joint of a step, and what went through it.
struct RigidTouch {
    dJointID joint;
    dBodyID body[2];          ///< the first is never the ground (null)
    RigidMotion motion[2];    ///< when the step began
    bool located;             ///< position, normal, depth and geoms are known
    dGeomID geom[2];          ///< of the bodies, in their order; null where not known
    Vec3 position;            ///< [m]
    Vec3 normal;              ///< into the first body
    double depth;             ///< [m]
    double friction;          ///< Coulomb's coefficient; negative where not known
    dJointFeedback* feedback; ///< ours or the application's
    bool ours;
    int recalled,
        recalled_count; ///< of a joint that was not seen: those in RigidTouches::recalled()

    // After the step:
    Vec3 impulse = Vec3::Zero();        ///< on the first body [N s]
    Vec3 turning = Vec3::Zero();        ///< about its centre [N m s]
    Vec3 second_turning = Vec3::Zero(); ///< of the second about its own
};

/// The contact joints of the bodies that sound, step by step. Puts feedback on those that have
/// none, and takes it off again. Allocates for more joints than ever before.
class RigidTouches {
public:
    void begin_step() noexcept;
    /// Notes the contacts of a body. Before ODE's step. @param met  met(other): whether that body's
    /// have been gathered already.
    template <class Met>
    void gather(dSoftWorldID world, dBodyID body, Met met) {
        const int joints = dBodyGetNumJoints(body);
        for (int j = 0; j < joints; ++j) {
            const dJointID joint = dBodyGetJoint(body, j);
            if (dJointGetType(joint) != dJointTypeContact)
                continue;
            const dBodyID first = dJointGetBody(joint, 0);
            const dBodyID other = first == body ? dJointGetBody(joint, 1) : first;
            if (other ? met(other) || !(dBodyIsEnabled(body) || dBodyIsEnabled(other))
                      : !dBodyIsEnabled(body))
                continue;
            add(world, joint);
        }
    }
    /// Reads what they bore. After ODE's step. @param h  [s].
    void read(double h) noexcept;

    std::vector<RigidTouch>& all() noexcept { return touch_; }
    std::span<const RecalledContact> recalled(const RigidTouch& touch) const noexcept {
        return std::span(recalled_).subspan(static_cast<std::size_t>(touch.recalled),
                                            static_cast<std::size_t>(touch.recalled_count));
    }

private:
    void add(dSoftWorldID world, dJointID joint);

    void recall(RigidTouch& touch);
    const RigidMotion& motion_of(dBodyID body);

    /// A body's motion is asked for by each of its joints.
    struct Moving {
        dBodyID body = nullptr;
        unsigned long step = 0;
        RigidMotion motion;
    };
    std::vector<Moving> moving_; ///< by address
    unsigned long step_ = 0;

    std::vector<RigidTouch> touch_;
    std::vector<RecalledContact> recalled_;
    std::deque<dJointFeedback> feedback_; ///< addresses last
    std::size_t used_ = 0;
};

} // namespace ode::sound
