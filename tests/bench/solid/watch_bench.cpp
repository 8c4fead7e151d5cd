// What the watch over stability costs a substep: the sums of a look, ten substeps apart, against
// the force that gives it the elastic energy as a by-product (bench_force tells that this costs
// nothing that can be measured).
#include "fma_peak.h"
#include "unit/model/specimens.h"

#include "mesh/generate.h"
#include "mesh/promote.h"
#include "model/make_model.h"
#include "world/energy_budget.h"

#include <benchmark/benchmark.h>

namespace ode::soft {
namespace {

template <class Work>
double least_seconds(int repeats, Work work) {
    double best = 1e300;
    for (int i = 0; i < repeats; ++i) {
        const double start = thread_seconds();
        work();
        best = std::min(best, thread_seconds() - start);
    }
    return best;
}

/// @param order  1 or 2, of the source paper's bowl.
void watch(benchmark::State& state) {
    TetMesh mesh = make_bowl(0.1, 0.005, 1.57, 8, 48, 1);
    if (state.range(0) == 2)
        mesh = promote_to_quadratic(mesh);
    Solid steel;
    steel.young = 200e9;
    steel.poisson = 0.29;
    steel.density = 7850;
    const auto model = make_model("stvk", mesh, {&steel, 1});
    NodeState motion{node_array(mesh.node), disturbed(NodeArray(mesh.node.size()), 1, 1)};
    NodeArray force(mesh.node.size()), load(mesh.node.size());
    double force_seconds = 1e300, look_seconds = 1e300;
    for (auto _ : state) {
        force_seconds = std::min(force_seconds, least_seconds(20, [&] {
                                     benchmark::DoNotOptimize(
                                         model->add_force(motion.position, motion.velocity, force));
                                 }));
        const double look = least_seconds(20, [&] {
            MotionSums before = kinetic_sums(model->mass(), motion.velocity);
            add_load_sums(model->mass(), motion.position, load, before);
            benchmark::DoNotOptimize(before);
            benchmark::DoNotOptimize(kinetic_sums(model->mass(), motion.velocity));
        });
        look_seconds = std::min(look_seconds, look);
        state.SetIterationTime(look);
    }
    constexpr double kInterval = 10; // substeps from look to look
    state.counters["force_us"] = 1e6 * force_seconds;
    state.counters["look_us"] = 1e6 * look_seconds;
    state.counters["percent_of_force"] = 100 * look_seconds / kInterval / force_seconds;
}
BENCHMARK(watch)->Arg(1)->Arg(2)->UseManualTime()->Iterations(200);

} // namespace
} // namespace ode::soft

BENCHMARK_MAIN();
