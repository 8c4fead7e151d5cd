#pragma once

#include "couple/soft_contact.h"

#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

class Body;

/// Everything between soft bodies during one ODE step: which pairs there are, and what each body's
/// surface needs for it. A body that meets no other, and not itself, has nothing here.
///
/// Contacts outlive the step while their pair stays near, for friction's memory.
class SoftExchange {
public:
    /// Takes up the pairs that the bodies' geoms have met, and bodies with self contact. One that
    /// stands still after an instability is an obstacle.
    void begin_step(std::span<const std::unique_ptr<Body>> bodies);

    /// Adds contact forces to the bodies' forces.
    SoftContactTally add_forces(double dt);

    std::size_t pairs() const noexcept { return contact_.size(); } ///< of the step

    void forget(const Body& body) noexcept; ///< a body is going

private:
    struct Surface {
        const Body* body;
        std::unique_ptr<SoftSurface> surface;
    };
    struct Contact {
        Body* a;
        Body* b;
        std::unique_ptr<SoftContact> law;
    };

    SoftSurface& surface_of(const Body& body);
    void meet(Body& a, Body& b);

    std::vector<Surface> surface_;
    std::vector<Contact> contact_; ///< of this step, by the order in which bodies were made
    std::vector<Contact> last_;    ///< of the step before, while begin_step() runs
    std::vector<double> held_;     ///< inverse masses of a body that stands still: zeros
    unsigned long substep_ = 0;
};

} // namespace ode::soft
