#pragma once

#include "integrate/stage.h"

namespace ode::soft {

/// Explicit (forward) Euler: x += h v, v += h a, both slopes from the start. First order. Turns
/// every undamped oscillation into an outward spiral, |z|^2 = 1 + (w h)^2: only damping makes a
/// step stable. Here to be compared with.
class ExplicitEuler final : public OneStageIntegrator {
public:
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;
};

} // namespace ode::soft
