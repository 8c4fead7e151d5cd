#pragma once

#include <ode/contact.h>

#include <unordered_map>

namespace ode::soft {

/// What each contact joint of a world was made of: ODE can be told a contact, but not asked.
///
/// Joints end without notice, and ODE uses their memory again; a new contact at the same place
/// overwrites the old one's record. So a record of a live joint is always its own, and there are
/// never more than there were contacts at once.
class ContactRecord {
public:
    void note(dJointID joint, const dContact& contact) { contact_[joint] = contact; }
    const dContact* find(dJointID joint) const noexcept {
        const auto found = contact_.find(joint);
        return found == contact_.end() ? nullptr : &found->second;
    }

private:
    std::unordered_map<dJointID, dContact> contact_;
};

} // namespace ode::soft
