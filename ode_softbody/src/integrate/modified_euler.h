#pragma once

#include "integrate/stage.h"

namespace ode::soft {

/// Modified Euler, also called Heun's method: the mean of the slopes at the start and at the end of
/// an explicit Euler step. Second order. Without damping |z|^2 = 1 + (w h)^4 / 4: it grows, slowly.
class ModifiedEuler final : public StagedIntegrator {
public:
    explicit ModifiedEuler(std::size_t nodes)
        : StagedIntegrator(nodes), end_{NodeArray(nodes), NodeArray(nodes)}, acceleration_(nodes) {}
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;

private:
    NodeState end_;
    NodeArray acceleration_;
};

} // namespace ode::soft
