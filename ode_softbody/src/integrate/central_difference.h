#pragma once

#include "integrate/stage.h"

namespace ode::soft {

/// v += h a without moving, with mass-proportional damping: the exact solution of
/// v' = a - alpha v over h, so that every mode decays by exp(-alpha h / 2) a step, no more and no
/// less. A negative h undoes the same positive one.
void kick(const NodeInertia& inertia, double h, const NodeArray& force,
          NodeArray& velocity) noexcept;

/// kick(), then x += h v: one pass over memory.
void kick_drift(const NodeInertia& inertia, double h, const NodeArray& force,
                NodeState& state) noexcept;

/// Central difference, also called leapfrog or Stoermer-Verlet: explicit, second order, symplectic
/// when undamped, one force a step. Between steps the velocity is that of half a step ago.
/// Viscosity sees this lagged velocity, which costs stability but no extra solve: critical_step().
class CentralDifference final : public OneStageIntegrator {
public:
    StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                        NodeState& state, NodeArray& force) noexcept override;
    void begin(const ElasticModel& model, const NodeInertia& inertia, double h, NodeState& state,
               NodeArray& force) noexcept override;
    void end(const ElasticModel& model, const NodeInertia& inertia, double h, NodeState& state,
             NodeArray& force) noexcept override;
};

} // namespace ode::soft
