#include "integrate/explicit_euler.h"

namespace ode::soft {

StrainExtremes ExplicitEuler::step(const ElasticModel&, const NodeInertia& inertia, double h,
                                   NodeState& state, NodeArray& force) noexcept {
    to_acceleration(inertia, state.velocity, force);
    add_scaled(state.position, h, state.velocity);
    add_scaled(state.velocity, h, force);
    return {};
}

} // namespace ode::soft
