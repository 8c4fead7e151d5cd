#pragma once

#include "couple/pair_contact.h"

#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

class Body;
class SoftVolume;

/// Everything between soft bodies during one ODE step. A body that meets no other, and not itself,
/// has nothing here.
///
/// Contacts outlive the step while their pair stays near, or sleeps, for friction's memory. Pairs
/// are kept in the order in which bodies were made, so that a step sorts those it met and merges
/// them with those it knew: n log n, and sums of forces don't depend on the order in which a space
/// finds its pairs.
class SoftExchange {
public:
    /// Takes up the pairs that the bodies' geoms have met, and bodies with self contact. One that
    /// stands still after an instability is an obstacle.
    /// @param again  the step is redone: contacts forget what has happened since its start.
    void begin_step(std::span<const std::unique_ptr<Body>> bodies, bool again);

    /// Adds contact forces to the bodies' forces.
    /// Before a substep: slows bodies that ring and may meet others.
    void look_ahead() noexcept;
    SoftContactTally add_forces(double dt);

    SoftContactMethod method() const noexcept { return method_; }
    /// Contacts begin anew where it is another one.
    void set_method(SoftContactMethod method) noexcept;

    std::size_t pairs() const noexcept { return active_.size(); } ///< of the step

    void forget(const Body& body) noexcept; ///< a body is going

private:
    struct Pair { ///< the body made first comes first; twice the same: self contact
        Body* a;
        Body* b;
    };
    struct Contact {
        Pair pair;
        std::unique_ptr<PairContact> law;
    };

    void collect_pairs(std::span<const std::unique_ptr<Body>> bodies);
    void merge_pairs();
    static bool before(const Pair& x, const Pair& y) noexcept;
    static SoftSurface& surface_of(Body& body);
    static SoftVolume& volume_of(Body& body);
    std::unique_ptr<PairContact> make_contact(const Pair& pair) const;

    SoftContactMethod method_ = SoftContactMethod::closest_point;
    std::vector<Pair> met_;        ///< in this step, ascending
    std::vector<Contact> contact_; ///< ascending
    std::vector<Contact> merged_;  ///< scratch of merge_pairs()
    std::vector<Contact*> active_; ///< those of this step
    std::vector<double> held_;     ///< inverse masses of a body that stands still: zeros
    unsigned long substep_ = 0;
};

} // namespace ode::soft
