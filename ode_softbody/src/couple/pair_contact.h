#pragma once

#include "couple/pair_law.h"

namespace ode::soft {

/// Work done in one call.
struct SoftContactTally {
    unsigned long looks = 0;   ///< searches through the trees
    unsigned long tests = 0;   ///< point against triangle
    unsigned long bearing = 0; ///< points that bore force
};

/// How soft bodies push each other apart.
enum class SoftContactMethod {
    closest_point, ///< SoftContact
    volume         ///< VolumeContact, P01's
};

/// How two soft bodies, or one body and itself, push each other apart. Kept from step to step as
/// long as the pair stays near, because friction has a memory.
class PairContact {
public:
    virtual ~PairContact() = default;
    PairContact() = default;
    PairContact(const PairContact&) = delete;
    PairContact& operator=(const PairContact&) = delete;

    virtual void begin_step(const SoftPartner& a, const SoftPartner& b) noexcept = 0;
    /// Remembers the start of a step, and goes back to it when the step is redone.
    virtual void keep() = 0;
    virtual void take_back() noexcept = 0;

    /// Adds forces to both sides.
    /// @param when  names the state of motion, for the trees.
    virtual SoftContactTally add_force(const SoftSide& a, const SoftSide& b, double dt,
                                       unsigned long when) = 0;
};

} // namespace ode::soft
