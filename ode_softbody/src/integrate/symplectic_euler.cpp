#include "integrate/symplectic_euler.h"

#include "integrate/central_difference.h"

namespace ode::soft {

StrainExtremes SymplecticEuler::step(const ElasticModel&, const NodeInertia& inertia, double h,
                                     NodeState& state, NodeArray& force) noexcept {
    kick_drift(inertia, h, force, state);
    return {};
}

} // namespace ode::soft
