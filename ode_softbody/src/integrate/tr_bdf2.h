#pragma once

#include "integrate/implicit_stage.h"
#include "integrate/stage.h"

namespace ode::soft {

/// TR-BDF2: the trapezoidal rule over gamma h, then the backward differentiation formula of second
/// order over both points, gamma = 2 - sqrt(2), so that both stages have one matrix (Bank et al.
/// 1985, doi:10.1109/T-ED.1985.22232). Second order; what the step cannot resolve dies away.
class TrBdf2 final : public StagedIntegrator {
public:
    explicit TrBdf2(std::size_t nodes) : StagedIntegrator(nodes), stage_(nodes) {}
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;

private:
    ImplicitStage stage_;
    NodeState before_, start_;
};

} // namespace ode::soft
