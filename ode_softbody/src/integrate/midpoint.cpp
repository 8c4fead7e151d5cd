#include "integrate/midpoint.h"

namespace ode::soft {

StrainExtremes Midpoint::step(const ElasticModel& model, const NodeInertia& inertia, double h,
                              NodeState& state, NodeArray& force) noexcept {
    const NodeArray& load = load_of(force);
    to_acceleration(inertia, state.velocity, force);
    middle_ = state;
    add_scaled(middle_.position, h / 2, state.velocity);
    add_scaled(middle_.velocity, h / 2, force);
    const StrainExtremes strain = accelerate(model, inertia, load, middle_, acceleration_);
    add_scaled(state.position, h, middle_.velocity);
    add_scaled(state.velocity, h, acceleration_);
    return strain;
}

} // namespace ode::soft
