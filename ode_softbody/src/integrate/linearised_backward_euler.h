#pragma once

#include "integrate/implicit_stage.h"
#include "integrate/stage.h"

namespace ode::soft {

/// Backward Euler about the linearised force, also called semi-implicit: one linear solution a step
/// (Baraff & Witkin 1998, doi:10.1145/280814.280821). Equals BackwardEuler on a linear body; where
/// the force bends within a step it may go unstable.
class LinearisedBackwardEuler final : public OneStageIntegrator {
public:
    explicit LinearisedBackwardEuler(std::size_t nodes) : stage_(nodes) {}
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;

private:
    ImplicitStage stage_;
};

} // namespace ode::soft
