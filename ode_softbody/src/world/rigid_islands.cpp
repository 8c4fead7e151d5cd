#include "world/rigid_islands.h"

#include <algorithm>

namespace ode::soft {
namespace {

bool moves_freely(dBodyID body) noexcept { return body && !dBodyIsKinematic(body); }

} // namespace

void RigidIslands::begin_step() noexcept {
    member_.clear();
    island_.clear();
    meeting_.clear();
}

bool RigidIslands::has(dBodyID body) const noexcept {
    return std::any_of(member_.begin(), member_.end(),
                       [&](const Member& m) { return m.body == body; });
}

void RigidIslands::reach(dBodyID body, const ContactRecord& record) {
    if (!moves_freely(body) || has(body))
        return;
    island_.push_back({false, false});
    member_.push_back({body, island_.size() - 1, false});
    for (std::size_t i = member_.size() - 1; i < member_.size(); ++i)
        follow_joints(i, record);
}

void RigidIslands::follow_joints(std::size_t member, const ContactRecord& record) {
    const dBodyID body = member_[member].body;
    const std::size_t here = member_[member].island;
    island_[here].awake |= dBodyIsEnabled(body) != 0;
    for (int i = 0; i < dBodyGetNumJoints(body); ++i) {
        const dJointID joint = dBodyGetJoint(body, i);
        const dJointType type = dJointGetType(joint);
        if (!dJointIsEnabled(joint) || type == dJointTypeNull)
            continue;
        const dBodyID first = dJointGetBody(joint, 0);
        const dBodyID second = dJointGetBody(joint, 1);
        if (type == dJointTypeContact) {
            const dContact* contact = record.find(joint);
            if (!contact)
                continue;
            island_[here].propped = true;
            if (body == first || !moves_freely(first)) // once, though both bodies come by
                meeting_.push_back({contact, first, second});
        } else {
            member_[member].jointed = true;
        }
        const dBodyID other = body == first ? second : first;
        if (moves_freely(other) && !has(other))
            member_.push_back({other, here, false});
    }
}

} // namespace ode::soft
