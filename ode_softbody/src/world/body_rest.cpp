// A body at rest and how it is told.
#include "world/body.h"
#include "world/soft_world.h"

#include <cmath>

namespace ode::soft {

void Body::wake() noexcept {
    quiet_ = 0;
    if (!asleep_)
        return;
    asleep_ = false;
    moved();
}

void Body::fall_asleep() noexcept {
    if (asleep_ || stopped_)
        return;
    leave_modes();
    asleep_ = true;
    bearing_points_ = 0;
    state_.velocity.set_zero();
    undamped_ = 0;
    if (has_external_)
        external_.set_zero();
    has_external_ = false;
    moved();
}

void Body::watch_rest(double passed) noexcept {
    const double speed2 = rest_limits_.speed * rest_limits_.speed;
    if (modes_) { // what vibrates so little hardly accelerates; what lies stays bent by its weight
        quiet_ = modes_->motion().is_slower(rest_limits_.speed, contact_nodes_.node)
                     ? quiet_ + passed
                     : 0;
        return;
    }
    const double most2 = rest_limits_.acceleration * rest_limits_.acceleration;
    for (std::size_t i = 0; i < state_.velocity.size(); ++i) {
        const double w = is_explicit_ ? inverse_mass_[i] : 0;
        if (!(state_.velocity[i].squaredNorm() <= speed2) ||
            !(w * w * force_[i].squaredNorm() <= most2)) {
            quiet_ = 0;
            return;
        }
    }
    quiet_ += passed;
}

} // namespace ode::soft
