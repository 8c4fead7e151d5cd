#include "integrate/backward_euler.h"

namespace ode::soft {

StrainExtremes BackwardEuler::step(const ElasticModel& model, const NodeInertia& inertia, double h,
                                   NodeState& state, NodeArray& force) noexcept {
    start_ = state;
    return stage_.solve({model, inertia, load_of(force), h}, start_, state);
}

} // namespace ode::soft
