#pragma once

#include "integrate/stage.h"

namespace ode::soft {

/// Symplectic Euler: v += h a, then x += h v with the new v. Its positions are those of
/// CentralDifference started from a velocity half a step old, so it is of first order; energy stays
/// bounded up to the same critical step.
class SymplecticEuler final : public OneStageIntegrator {
public:
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;
};

} // namespace ode::soft
