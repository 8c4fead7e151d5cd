// Nanoseconds of one core for the force of one element, and what share that is of the multiply-adds
// that the same core reaches in a loop that does nothing else (fma_peak.h).
#include "counting_lane.h"
#include "fma_peak.h"
#include "unit/model/specimens.h"

#include "base/error.h"
#include "model/corotated.h"
#include "model/stable_neo_hookean.h"
#include "model/stvk_lanes.h"
#include "model/stvk_linear.h"
#include "model/stvk_quadratic.h"
#include "model/tet10_lanes.h"

#include <benchmark/benchmark.h>

#include <map>

namespace ode::soft {
namespace {

/// Floating-point operations for one element; a fused multiply-add is two.
template <class Packs>
double operations(const TetMesh& mesh, const Solid& solid) {
    const Packs packs(mesh, std::span(&solid, 1));
    const TetBlock& block = packs.blocks()[0];
    const NodeArray x = node_array(mesh.node);
    NodeArray force(x.size());
    DeformationRange range{};
    const auto run =
        scalar::choose_kernel<CountingLane, scalar::Stvk>(block.shape, solid.is_viscous());
    Counted::operations = 0;
    run(packs.pack(block), 1, StvkConstants{}, x.data(), x.data(), force.data(), range);
    return double(Counted::operations) / kPackWidth;
}

template <class Law, class Packs>
void run(benchmark::State& state, Isa isa, bool viscous) {
    if (!is_supported(isa)) {
        state.SkipWithError("not supported by this processor");
        return;
    }
    const int n = static_cast<int>(state.range(0));
    TetMesh mesh =
        state.range(1) == 1 ? box_mesh({0.3, 0.3, 0.005}, n, n, 1) : box_mesh({1, 1, 1}, n, n, n);
    if (std::is_same_v<Packs, Tet10Packs>)
        mesh = with_mid_nodes(mesh);
    Solid steel;
    steel.young = 200e9;
    steel.poisson = 0.29;
    steel.density = 7850;
    steel.beta = viscous ? 1e-7 : 0;
    const TetModel<Law, Packs> model(mesh, steel, isa);
    NodeArray x(model.node_count()), v(model.node_count()), force(model.node_count());
    for (std::size_t i = 0; i < model.node_count(); ++i)
        x[i] = 1.001 * mesh.node[i];

    static std::map<Isa, double> peak;
    if (peak.find(isa) == peak.end())
        peak[isa] = fma_peak(isa);
    double best = 1e300, total = 0;
    for (auto _ : state) {
        const double start = thread_seconds();
        benchmark::DoNotOptimize(model.add_force(x, v, force));
        const double seconds = thread_seconds() - start;
        state.SetIterationTime(seconds);
        best = std::min(best, seconds);
        total += seconds;
    }
    const double elements = double(mesh.element_count());
    state.counters["ns/element"] = 1e9 * best / elements;
    state.counters["mean_ns"] = 1e9 * total / double(state.iterations()) / elements;
    if (std::is_same_v<Law, StvkLaw>) { // the only law whose kernel the counting lane can run
        const double rate = operations<Packs>(mesh, steel) * elements / best;
        state.counters["GFLOP/s"] = 1e-9 * rate;
        state.counters["peak"] = 1e-9 * peak[isa];
        state.counters["share"] = rate / peak[isa];
    }
    state.counters["elements"] = elements;
}

template <class Law, class Packs>
void enlist(const char* name) {
    for (const bool viscous : {false, true})
        for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::baseline})
            benchmark::RegisterBenchmark(
                format("%s/%s/%s", name, viscous ? "viscous" : "elastic", isa_name(isa)).c_str(),
                [=](benchmark::State& s) { run<Law, Packs>(s, isa, viscous); })
                ->Args({14, 1})  // 1176 tetrahedra: the source paper's bowl
                ->Args({20, 20}) // 48 k
                ->Args({40, 40}) // 384 k
                ->UseManualTime();
}

} // namespace
} // namespace ode::soft

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    using namespace ode::soft;
    enlist<StvkLaw, Tet4Packs>("stvk/tet4");
    enlist<StvkLaw, Tet10Packs>("stvk/tet10");
    enlist<CorotatedLaw, Tet4Packs>("corotated/tet4");
    enlist<StableNeoHookeanLaw, Tet4Packs>("stable_neo_hookean/tet4");
    enlist<StableNeoHookeanLaw, Tet10Packs>("stable_neo_hookean/tet10");
    benchmark::RunSpecifiedBenchmarks();
}
