// Cost of node contact: nanoseconds per bearing point and substep, and per node that is only near.
#include "couple/node_contact.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ode::soft;

SurfaceNodes grid_nodes(std::size_t count) {
    SurfaceNodes nodes;
    for (std::size_t i = 0; i < count; ++i) {
        nodes.node.push_back(static_cast<int>(i));
        nodes.area.push_back(1e-4);
        nodes.mass.push_back(1e-3);
    }
    nodes.mean_edge = 0.01;
    nodes.mass_per_area = 10;
    return nodes;
}

RigidShape shape_of(ShapeKind kind) {
    RigidShape shape;
    shape.kind = kind;
    shape.size = Vec3(0.5, 0.5, 0.5);
    return shape;
}

/// @param arg 0: kind of shape, 1: nodes, 2: depth of the nodes [um], negative: above the surface
void BM_NodeContact(benchmark::State& state) {
    const RigidShape shape = shape_of(static_cast<ShapeKind>(state.range(0)));
    const auto count = static_cast<std::size_t>(state.range(1));
    const double depth = 1e-6 * static_cast<double>(state.range(2));
    const SurfaceNodes nodes = grid_nodes(count);
    const std::vector<double> inverse_mass(count, 1e3);
    NodeArray position(count);
    NodeArray velocity(count);
    NodeArray force(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 x(0.01 * static_cast<double>(i % 16), 0.01 * static_cast<double>(i / 16 % 16),
                     2);
        const SurfaceDistance gap = shape.distance(x);
        position[i] = x - (gap.distance + depth) * gap.normal;
        velocity[i] = Vec3(1e-3, 0, 0);
    }
    RigidShadow ground;
    NodeContact contact(nodes, nullptr);
    contact.begin_step(shape, ContactLaw{}, inverse_mass, 1e-5);
    ContactTally tally;
    for (auto _ : state) {
        tally = contact.add_force(position, velocity, ground, 1e-9, force);
        benchmark::ClobberMemory();
    }
    state.counters["bearing"] = static_cast<double>(tally.bearing);
    state.counters["per_node"] = benchmark::Counter(static_cast<double>(count),
                                                    benchmark::Counter::kIsIterationInvariantRate |
                                                        benchmark::Counter::kInvert);
}

constexpr int64_t kKinds[] = {
    static_cast<int64_t>(ShapeKind::plane), static_cast<int64_t>(ShapeKind::sphere),
    static_cast<int64_t>(ShapeKind::box), static_cast<int64_t>(ShapeKind::capsule),
    static_cast<int64_t>(ShapeKind::cylinder)};

void arguments(benchmark::internal::Benchmark* bench) {
    bench->ArgNames({"shape", "nodes", "depth_um"});
    for (const int64_t kind : kKinds)
        for (const int64_t depth : {10, -10, -1000000})
            bench->Args({kind, 256, depth});
}

BENCHMARK(BM_NodeContact)->Apply(arguments);

} // namespace

BENCHMARK_MAIN();
