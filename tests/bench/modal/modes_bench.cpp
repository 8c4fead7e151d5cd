// Run time of a modal analysis, with what it reached beside it: the bowl of the demo and a block.
#include "mesh/generate.h"
#include "mesh/promote.h"
#include "modal/to_tolerance.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <numbers>
#include <sys/resource.h>

namespace {

using namespace ode::soft;

const Solid kSteel{.young = 200e9, .poisson = 0.29, .density = 7850};

void solve(benchmark::State& state, const TetMesh& mesh, const ModalOptions& options,
           bool rebuild) {
    ToleranceOptions tolerance;
    tolerance.rebuild_curves = rebuild;
    ModalModel model;
    for (auto _ : state)
        model = modes_to_tolerance(mesh, std::span(&kSteel, 1), options, tolerance).model;
    state.counters["quadratic_nodes"] = static_cast<double>(promote_to_quadratic(mesh).node.size());
    state.counters["modes"] = static_cast<double>(model.mode_count());
    state.counters["f1_Hz"] = model.frequency.empty() ? 0 : model.frequency[0];
    if (!model.error_cents.empty())
        state.counters["widest_band_cents"] =
            *std::max_element(model.error_cents.begin(), model.error_cents.end());
    rusage use = {};
    getrusage(RUSAGE_SELF, &use);
    state.counters["peak_MiB_so_far"] = static_cast<double>(use.ru_maxrss) / 1024;
}

/// All modes to 22 kHz. @param arg 0: order, 1: with the band, 2: curves rebuilt
void BM_Bowl(benchmark::State& state) {
    ModalOptions options;
    options.order = static_cast<int>(state.range(0));
    options.estimate = state.range(1) != 0;
    solve(state, make_bowl(0.1, 0.005, std::numbers::pi / 2, 8, 48, 1), options,
          state.range(2) != 0);
}
BENCHMARK(BM_Bowl)
    ->ArgNames({"order", "band", "rebuilt"})
    ->Args({2, 0, 0})
    ->Args({3, 0, 0})
    ->Args({3, 1, 0})
    ->Args({3, 1, 1})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

/// Forty modes of a block of some 20 000 quadratic nodes.
void BM_Block(benchmark::State& state) {
    ModalOptions options;
    options.order = 2;
    options.estimate = false;
    options.max_modes = 40;
    options.max_frequency = 1e6;
    solve(state, make_box({0.3, 0.2, 0.1}, 18, 12, 10), options, false);
}
BENCHMARK(BM_Block)->Iterations(1)->Unit(benchmark::kSecond);

/// Twenty modes of a plate of some 100 000 quadratic nodes. @param arg 0: order, 1: with the band
void BM_LargePlate(benchmark::State& state) {
    ModalOptions options;
    options.order = static_cast<int>(state.range(0));
    options.estimate = state.range(1) != 0;
    options.max_modes = 20;
    options.max_frequency = 1e6;
    solve(state, make_box({0.6, 0.6, 0.03}, 60, 60, 3), options, false);
}
BENCHMARK(BM_LargePlate)
    ->ArgNames({"order", "band"})
    ->Args({2, 0})
    ->Args({3, 1})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

} // namespace

BENCHMARK_MAIN();
