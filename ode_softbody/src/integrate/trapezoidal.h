#pragma once

#include "integrate/one_solve.h"

namespace ode::soft {

/// Trapezoidal rule, which is Newmark's method with beta = 1/4, gamma = 1/2: both slopes are means
/// of start and end. Second order; |z| = 1 at any step on a linear body, so that nothing is lost
/// and nothing that the step cannot resolve dies away.
class Trapezoidal final : public OneSolveIntegrator {
public:
    using OneSolveIntegrator::OneSolveIntegrator;
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;
};

} // namespace ode::soft
