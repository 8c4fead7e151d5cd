#pragma once

#include "integrate/one_solve.h"

namespace ode::soft {

/// Backward Euler solved to convergence: x += h v, v += h a, both slopes from the end. First order.
/// Stable at any step, at the price of damping: |z|^2 = 1 / (1 + (w h)^2).
class BackwardEuler final : public OneSolveIntegrator {
public:
    using OneSolveIntegrator::OneSolveIntegrator;
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;
};

} // namespace ode::soft
