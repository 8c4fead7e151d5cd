#pragma once

#include "integrate/integrator.h"

#include <algorithm>

namespace ode::soft {

/// y += a x.
inline void add_scaled(NodeArray& y, double a, const NodeArray& x) noexcept {
    double* to = y.data();
    const double* from = x.data();
    const std::size_t n = NodeArray::kStride * y.size();
    for (std::size_t i = 0; i < n; ++i)
        to[i] += a * from[i];
}

/// Force [N] becomes acceleration [m/s^2]: f/m - alpha v. Held nodes have none.
inline void to_acceleration(const NodeInertia& inertia, const NodeArray& velocity,
                            NodeArray& force) noexcept {
    for (std::size_t i = 0; i < force.size(); ++i) {
        const double inverse = inertia.inverse_mass[i];
        force[i] *= inverse;
        if (inverse != 0)
            force[i] -= inertia.alpha * velocity[i];
    }
}

/// A method that looks at the material once a step, at its start.
class OneStageIntegrator : public Integrator {
public:
    StrainExtremes evaluate(const ElasticModel& model, const NodeState& state,
                            NodeArray& force) noexcept override {
        return model.add_force(state.position, state.velocity, force);
    }
};

/// A method that looks at the material at more than one state of a step. It keeps the material's
/// share of the force at the start, so that the rest, which is constant, can be told from it.
class StagedIntegrator : public Integrator {
public:
    explicit StagedIntegrator(std::size_t nodes) : material_(nodes) {}

    StrainExtremes evaluate(const ElasticModel& model, const NodeState& state,
                            NodeArray& force) noexcept override {
        material_.set_zero();
        const StrainExtremes strain = model.add_force(state.position, state.velocity, material_);
        add_scaled(force, 1, material_);
        return strain;
    }

protected:
    /// Of all force at the start: what isn't the material's stays. [N]
    const NodeArray& load_of(const NodeArray& force) noexcept {
        // In place: the material's share is not needed again.
        double* to = material_.data();
        const std::size_t n = NodeArray::kStride * material_.size();
        for (std::size_t i = 0; i < n; ++i)
            to[i] = force.data()[i] - to[i];
        return material_;
    }

    /// out = acceleration at a later stage.
    static StrainExtremes accelerate(const ElasticModel& model, const NodeInertia& inertia,
                                     const NodeArray& load, const NodeState& at,
                                     NodeArray& out) noexcept {
        std::copy_n(load.data(), NodeArray::kStride * load.size(), out.data());
        const StrainExtremes strain = model.add_force(at.position, at.velocity, out);
        to_acceleration(inertia, at.velocity, out);
        return strain;
    }

    static void include(StrainExtremes& worst, const StrainExtremes& other) noexcept {
        worst.min_jacobian = std::min(worst.min_jacobian, other.min_jacobian);
        worst.max_stretch = std::max(worst.max_stretch, other.max_stretch);
    }

private:
    NodeArray material_;
};

} // namespace ode::soft
