#include "integrate/tr_bdf2.h"

#include <numbers>

namespace ode::soft {

StrainExtremes TrBdf2::step(const ElasticModel& model, const NodeInertia& inertia, double h,
                            NodeState& state, NodeArray& force) noexcept {
    constexpr double kGamma = 2 - std::numbers::sqrt2;
    constexpr double kNew = 1 / (kGamma * (2 - kGamma));
    const double c = kGamma / 2 * h; // (1 - gamma) / (2 - gamma) = gamma / 2
    const NodeArray& load = load_of(force);
    to_acceleration(inertia, state.velocity, force);
    before_ = state;
    start_ = state;
    add_scaled(start_.position, c, state.velocity);
    add_scaled(start_.velocity, c, force);
    const StrainExtremes middle = stage_.solve({model, inertia, load, c}, start_, state);

    // The formula's weights are 1 / (gamma (2 - gamma)) and 1 less: what stands still does so to
    // the bit.
    const auto combine = [](const NodeArray& now, const NodeArray& before, NodeArray& out) {
        const std::size_t n = NodeArray::kStride * now.size();
        for (std::size_t i = 0; i < n; ++i)
            out.data()[i] = before.data()[i] + kNew * (now.data()[i] - before.data()[i]);
    };
    combine(state.position, before_.position, start_.position);
    combine(state.velocity, before_.velocity, start_.velocity);
    StrainExtremes worst = stage_.solve({model, inertia, load, c}, start_, state);
    include(worst, middle);
    return worst;
}

} // namespace ode::soft
