#pragma once

#include "couple/contact_record.h"

#include <ode/objects.h>

#include <cstddef>
#include <span>
#include <vector>

namespace ode::soft {

/// The rigid bodies that move with those near a soft one: linked to them by joints, or by contacts
/// that were recorded. Kinematic bodies and the ground belong to no island and link none.
///
/// Far from soft bodies nothing is looked at. No limit is put to an island's size: one that is
/// built of a hundred bodies is substepped whole.
class RigidIslands {
public:
    struct Member {
        dBodyID body;
        std::size_t island;
        bool jointed; ///< by joints other than contacts
    };
    struct Island {
        bool propped; ///< holds contacts between its bodies, or with the ground
        bool awake;   ///< some body is
    };
    /// A contact joint of this step. The normal points to the first body.
    struct Meeting {
        const dContact* contact;
        dBodyID first;
        dBodyID second;
    };

    void begin_step() noexcept;
    /// A body that a soft one may touch in this step: its island is near.
    void reach(dBodyID body, const ContactRecord& record);

    void wake(std::size_t island) noexcept { island_[island].awake = true; }

    std::span<const Member> members() const noexcept { return member_; }
    std::span<const Island> islands() const noexcept { return island_; }
    std::span<const Meeting> meetings() const noexcept { return meeting_; }

private:
    bool has(dBodyID body) const noexcept;
    void follow_joints(std::size_t member, const ContactRecord& record);

    std::vector<Member> member_;
    std::vector<Island> island_;
    std::vector<Meeting> meeting_;
};

} // namespace ode::soft
