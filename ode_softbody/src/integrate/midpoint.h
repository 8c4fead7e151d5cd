#pragma once

#include "integrate/stage.h"

namespace ode::soft {

/// Explicit midpoint method: half an Euler step, and the whole step with the slope found there.
/// Second order; amplifies as ModifiedEuler does.
class Midpoint final : public StagedIntegrator {
public:
    explicit Midpoint(std::size_t nodes)
        : StagedIntegrator(nodes), middle_{NodeArray(nodes), NodeArray(nodes)},
          acceleration_(nodes) {}
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;

private:
    NodeState middle_;
    NodeArray acceleration_;
};

} // namespace ode::soft
