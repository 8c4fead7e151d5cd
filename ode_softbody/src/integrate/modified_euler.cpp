#include "integrate/modified_euler.h"

namespace ode::soft {

StrainExtremes ModifiedEuler::step(const ElasticModel& model, const NodeInertia& inertia, double h,
                                   NodeState& state, NodeArray& force) noexcept {
    const NodeArray& load = load_of(force);
    NodeArray& start = force;
    to_acceleration(inertia, state.velocity, start);
    end_ = state;
    add_scaled(end_.position, h, state.velocity);
    add_scaled(end_.velocity, h, start);
    const StrainExtremes strain = accelerate(model, inertia, load, end_, acceleration_);
    add_scaled(state.position, h / 2, state.velocity);
    add_scaled(state.position, h / 2, end_.velocity);
    add_scaled(state.velocity, h / 2, start);
    add_scaled(state.velocity, h / 2, acceleration_);
    return strain;
}

} // namespace ode::soft
