#include "integrate/trapezoidal.h"

namespace ode::soft {

StrainExtremes Trapezoidal::step(const ElasticModel& model, const NodeInertia& inertia, double h,
                                 NodeState& state, NodeArray& force) noexcept {
    const NodeArray& load = load_of(force);
    to_acceleration(inertia, state.velocity, force);
    start_ = state;
    add_scaled(start_.position, h / 2, state.velocity);
    add_scaled(start_.velocity, h / 2, force);
    return stage_.solve({model, inertia, load, h / 2}, start_, state);
}

} // namespace ode::soft
