#include "integrate/linearised_backward_euler.h"

namespace ode::soft {

StrainExtremes LinearisedBackwardEuler::step(const ElasticModel& model, const NodeInertia& inertia,
                                             double h, NodeState& state,
                                             NodeArray& force) noexcept {
    return stage_.solve_linearised({model, inertia, force, h}, force, state) ? StrainExtremes{}
                                                                             : kFailedStep;
}

} // namespace ode::soft
