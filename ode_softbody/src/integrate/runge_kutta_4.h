#pragma once

#include "integrate/stage.h"

namespace ode::soft {

/// The classical Runge-Kutta method of fourth order. Stable to w h = 2 sqrt(2) without damping,
/// losing (w h)^6 / 144 of an amplitude a step.
class RungeKutta4 final : public StagedIntegrator {
public:
    explicit RungeKutta4(std::size_t nodes)
        : StagedIntegrator(nodes), stage_{NodeArray(nodes), NodeArray(nodes)},
          sum_{NodeArray(nodes), NodeArray(nodes)}, acceleration_(nodes) {}
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;

private:
    NodeState stage_, sum_;
    NodeArray acceleration_;
};

} // namespace ode::soft
