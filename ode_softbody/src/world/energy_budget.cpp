#include "world/energy_budget.h"

#include "base/tasks.h"

#include <array>

namespace ode::soft {
namespace {

// Four numbers a node, as they lie in memory: the fourth is zero.
struct Pair {
    double first[4] = {}, second[4] = {};
};

/// @param add  add(node, component, first, second) adds to both sums.
template <class Add>
Pair sum_up(std::size_t nodes, Add add) noexcept {
    std::array<Pair, kMostRanges> part;
    const std::size_t ranges = range_count(nodes, kLeastNodes);
    in_pieces(ranges, [&](std::size_t r) {
        Pair sum; // of its own: neighbours in `part` share cache lines
        for (std::size_t i = nodes * r / ranges; i < nodes * (r + 1) / ranges; ++i)
            for (std::size_t c = 0; c < 4; ++c)
                add(i, 4 * i + c, sum.first[c], sum.second[c]);
        part[r] = sum;
    });
    for (std::size_t r = 1; r < ranges; ++r)
        for (std::size_t c = 0; c < 4; ++c) {
            part[0].first[c] += part[r].first[c];
            part[0].second[c] += part[r].second[c];
        }
    return part[0];
}

} // namespace

MotionSums kinetic_sums(std::span<const double> mass, const NodeArray& velocity) noexcept {
    const double* v = velocity.data();
    const auto [momentum, square] =
        sum_up(mass.size(), [&](std::size_t node, std::size_t at, double& p, double& pv) {
            const double own = mass[node] * v[at];
            p += own;
            pv += own * v[at];
        });
    MotionSums sum;
    sum.kinetic = (square[0] + square[1] + square[2]) / 2;
    sum.momentum = Vec3(momentum[0], momentum[1], momentum[2]);
    return sum;
}

void add_load_sums(std::span<const double> mass, const NodeArray& position, const NodeArray& load,
                   MotionSums& sum) noexcept {
    const double* x = position.data();
    const double* f = load.data();
    const auto [moment, work] =
        sum_up(mass.size(), [&](std::size_t node, std::size_t at, double& m, double& w) {
            m += mass[node] * x[at];
            w += f[at] * x[at];
        });
    sum.load = work[0] + work[1] + work[2];
    sum.moment = Vec3(moment[0], moment[1], moment[2]);
}

} // namespace ode::soft
