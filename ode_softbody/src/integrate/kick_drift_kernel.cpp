// Compiled once for every instruction set.
#include "integrate/kick_drift_kernel.h"

#include "base/lane.h"

namespace ode::soft::ODE_SOFT_ISA {
namespace {

// One node is four numbers: wider registers would only need the masses shuffled.
#if defined(__AVX2__) && defined(__FMA__)
using NodeLane = Lane<4>;
#else
using NodeLane = Lane<2>;
#endif

template <bool kDrift>
void run(std::size_t nodes, const double* inverse_mass, const KickDriftFactors& by,
         const double* force, double* velocity, double* position) {
    using Value = NodeLane::Value;
    const Value zero{};
    for (std::size_t node = 0; node < nodes; ++node) {
        const Value gain = zero + by.gain * inverse_mass[node];
        const Value keep = zero + (inverse_mass[node] == 0 ? 1.0 : by.keep);
        for (std::size_t i = 4 * node; i < 4 * node + 4; i += NodeLane::kWidth) {
            const Value v =
                NodeLane::fma(NodeLane::load(force + i), gain, NodeLane::load(velocity + i) * keep);
            NodeLane::store(velocity + i, v);
            if constexpr (kDrift)
                NodeLane::store(position + i,
                                NodeLane::fma(v, zero + by.drift, NodeLane::load(position + i)));
        }
    }
}

void choose(std::size_t nodes, const double* inverse_mass, const KickDriftFactors& by,
            const double* force, double* velocity, double* position) {
    (position != nullptr ? run<true> : run<false>)(nodes, inverse_mass, by, force, velocity,
                                                   position);
}

} // namespace

KickDrift kick_drift_kernel();

KickDrift kick_drift_kernel() { return choose; }

} // namespace ode::soft::ODE_SOFT_ISA
