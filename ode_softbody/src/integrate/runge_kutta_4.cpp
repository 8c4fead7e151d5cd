#include "integrate/runge_kutta_4.h"

namespace ode::soft {

StrainExtremes RungeKutta4::step(const ElasticModel& model, const NodeInertia& inertia, double h,
                                 NodeState& state, NodeArray& force) noexcept {
    const NodeArray& load = load_of(force);
    to_acceleration(inertia, state.velocity, force);
    std::copy_n(force.data(), NodeArray::kStride * force.size(), acceleration_.data());
    stage_ = state;
    sum_ = state;
    StrainExtremes worst;
    constexpr double kWeight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    constexpr double kReach[] = {0.5, 0.5, 1};
    for (int i = 0;; ++i) {
        add_scaled(sum_.position, kWeight[i] * h, stage_.velocity);
        add_scaled(sum_.velocity, kWeight[i] * h, acceleration_);
        if (i == 3)
            break;
        // The slope is that of the stage before: its velocity is needed before it is replaced.
        NodeArray& position = stage_.position;
        const std::size_t n = NodeArray::kStride * position.size();
        const double reach = kReach[i] * h;
        for (std::size_t k = 0; k < n; ++k) {
            position.data()[k] = state.position.data()[k] + reach * stage_.velocity.data()[k];
            stage_.velocity.data()[k] = state.velocity.data()[k] + reach * acceleration_.data()[k];
        }
        include(worst, accelerate(model, inertia, load, stage_, acceleration_));
    }
    std::swap(state, sum_);
    return worst;
}

} // namespace ode::soft
