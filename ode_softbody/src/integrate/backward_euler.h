#pragma once

#include "integrate/implicit_stage.h"
#include "integrate/stage.h"

namespace ode::soft {

/// Backward Euler solved to convergence: x += h v, v += h a, both slopes from the end. First order.
/// Stable at any step, at the price of damping: |z|^2 = 1 / (1 + (w h)^2).
class BackwardEuler final : public StagedIntegrator {
public:
    explicit BackwardEuler(std::size_t nodes) : StagedIntegrator(nodes), stage_(nodes) {}
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;

private:
    ImplicitStage stage_;
    NodeState start_;
};

} // namespace ode::soft
