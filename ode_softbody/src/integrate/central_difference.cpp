#include "integrate/central_difference.h"

#include "base/isa.h"
#include "base/tasks.h"
#include "integrate/kick_drift_kernel.h"

#include <cmath>

namespace ode::soft {

namespace baseline {
KickDrift kick_drift_kernel();
}
#if defined(__x86_64__)
namespace avx2 {
KickDrift kick_drift_kernel();
}
namespace avx512 {
KickDrift kick_drift_kernel();
}
#endif

namespace {

KickDrift kernel() noexcept {
    switch (active_isa()) {
#if defined(__x86_64__)
    case Isa::avx512:
        return avx512::kick_drift_kernel();
    case Isa::avx2:
        return avx2::kick_drift_kernel();
#endif
    default:
        return baseline::kick_drift_kernel();
    }
}

void run(const NodeInertia& inertia, double h, double drift, const NodeArray& force,
         NodeArray& velocity, double* position) noexcept {
    static const KickDrift run_kernel = kernel();
    const double s = inertia.alpha * h;
    const double gain = s == 0 ? h : h * (-std::expm1(-s) / s);
    const KickDriftFactors by{std::exp(-s), gain, drift};
    in_ranges(velocity.size(), kLeastNodes, [&](std::size_t first, std::size_t last) {
        const std::size_t at = NodeArray::kStride * first;
        run_kernel(last - first, inertia.inverse_mass.data() + first, by, force.data() + at,
                   velocity.data() + at, position ? position + at : nullptr);
    });
}

} // namespace

void kick(const NodeInertia& inertia, double h, const NodeArray& force,
          NodeArray& velocity) noexcept {
    run(inertia, h, 0, force, velocity, nullptr);
}

void kick_drift(const NodeInertia& inertia, double h, const NodeArray& force,
                NodeState& state) noexcept {
    run(inertia, h, h, force, state.velocity, state.position.data());
}

StrainExtremes CentralDifference::step(const ElasticModel&, const NodeInertia& inertia, double h,
                                       NodeState& state, NodeArray& force) noexcept {
    kick_drift(inertia, h, force, state);
    return {};
}

void CentralDifference::begin(const ElasticModel& model, const NodeInertia& inertia, double h,
                              NodeState& state, NodeArray& force) noexcept {
    model.add_force(state.position, state.velocity, force);
    kick(inertia, -h / 2, force, state.velocity);
}

void CentralDifference::end(const ElasticModel& model, const NodeInertia& inertia, double h,
                            NodeState& state, NodeArray& force) noexcept {
    model.add_force(state.position, state.velocity, force);
    kick(inertia, h / 2, force, state.velocity);
}

} // namespace ode::soft
