#pragma once

#include "integrate/implicit_stage.h"
#include "integrate/stage.h"

namespace ode::soft {

/// A method that solves for the new state once a step.
class OneSolveIntegrator : public StagedIntegrator {
public:
    explicit OneSolveIntegrator(std::size_t nodes) : StagedIntegrator(nodes), stage_(nodes) {}

protected:
    ImplicitStage stage_;
    NodeState start_; ///< x* and v* of the equation
};

} // namespace ode::soft
