// Cost of the sound path at the substep, with its errors beside it.
//
// The surface is the issue's: about 432 nodes and 864 triangles, substeps of 0.6 us, two ears at
// 48 kHz. Mark: 0.8 us a substep, 6 % of an explicit step of 13 us.
#include "dsp/kernels.h"
#include "dsp/splat_table.h"
#include "mix/voice_model.h"
#include "physics/sound/rig.h"

#include <benchmark/benchmark.h>
#include <random>

namespace ode::sound::test {
namespace {

/// Torus-shaped net of n by m cells: n m nodes, 2 n m triangles, closed, no poles.
Shape make_torus(int n, int m) {
    Shape s;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const double a = kTau * i / n, b = kTau * j / m;
            const double r = 0.1 + 0.03 * std::cos(b);
            s.node.emplace_back(r * std::cos(a), r * std::sin(a), 0.03 * std::sin(b));
        }
    const auto at = [=](int i, int j) { return (i % n) * m + j % m; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j)
            s.triangle.insert(s.triangle.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j),
                                                 at(i + 1, j + 1), at(i, j + 1)});
    return s;
}

void substeps(benchmark::State& state, Radiation radiation, Sampling sampling, int listeners) {
    constexpr double kDt = 0.6e-6;
    constexpr int kRound = 4096; // places prepared ahead, so that only the sound path is timed
    Settings settings;
    settings.radiation = radiation;
    settings.sampling = sampling;
    const Shape shape = make_torus(36, 12);
    std::vector<double> position(4 * shape.node.size(), 0.0), velocity(position);
    Scene scene;
    scene.set(settings);
    for (int i = 0; i < listeners; ++i)
        scene.add_listener(0.0).pose.centre = {0.0, 0.0, 1.0 + i};
    // The first view is set aside: it makes room, and finds the air that the body carries.
    for (std::size_t i = 0; i < shape.node.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            position[4 * i + k] = shape.node[i][static_cast<Eigen::Index>(k)];
    scene.push(&shape, shape.triangle, {kDt, kDt, position.data(), velocity.data(), 4});
    long n = 1;
    for (auto _ : state) {
        // All nodes swing along z, amplitude 1 um: as cheap a motion as there is.
        const double t = static_cast<double>(++n) * kDt;
        const double z = 1e-6 * std::sin(6000.0 * t);
        for (std::size_t i = 0; i < shape.node.size(); i += 16) // a few nodes move, no more
            position[4 * i + 2] = shape.node[i][2] + z;
        scene.push(&shape, shape.triangle, {t, kDt, position.data(), velocity.data(), 4});
        if (n % kRound == 0)
            scene.end_step(t);
    }
    state.counters["nodes"] = static_cast<double>(shape.node.size());
    state.counters["share_of_13us"] =
        benchmark::Counter(13e-6 * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void BM_Substep(benchmark::State& state) {
    substeps(state, Radiation::kMonopole, Sampling::kSinc, static_cast<int>(state.range(0)));
}
BENCHMARK(BM_Substep)->Arg(1)->Arg(2)->Arg(4)->Arg(16)->ArgName("listeners");

/// Volume flow of `nodes` within `millimetres`, half a metre away, to two ears at one sample.
/// Arrivals of like delay are summed before they are spread where that costs less: `nodes_a_cell`.
void BM_Splat(benchmark::State& state) {
    const auto nodes = static_cast<std::size_t>(state.range(0));
    const double size = 1e-3 * static_cast<double>(state.range(1));
    AlignedVector position(4 * nodes, 0.0), zero(4 * nodes, 0.0), flow(nodes, 1.0);
    AlignedVector softening(nodes, 1e-6);
    std::mt19937 bits(1);
    for (std::size_t i = 0; i < nodes; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            position[4 * i + k] = size * (static_cast<double>(bits()) / std::mt19937::max() - 0.5);
    constexpr std::size_t kCells = 1 << 14;
    std::vector<double> ring[4];
    for (auto& r : ring)
        r.assign(kCells + SplatTable::kTaps, 0.0);
    SplatEar ear[2];
    for (int e = 0; e < 2; ++e)
        ear[e] = {{0.5, 0.2 * e - 0.1, 0.0, 0.0},
                  {0.0, 0.0, 0.0, 0.0},
                  {ring[2 * e].data(), ring[2 * e + 1].data()},
                  kCells - 1,
                  0,
                  1.0,
                  0.0,
                  5000.0};
    const SplatSurface surface{static_cast<int>(nodes),
                               position.data(),
                               zero.data(),
                               softening.data(),
                               flow.data(),
                               zero.data(),
                               zero.data(),
                               96000.0 / 343.0,
                               splat_table().rows(),
                               splat_table().moments()};
    for (auto _ : state) {
        benchmark::DoNotOptimize(kernels().splat[0](surface, ear, 2));
        for (SplatEar& e : ear)
            ++e.sample;
    }
    state.counters["ns_a_node_and_ear"] = benchmark::Counter(
        2.0e-9 * static_cast<double>(nodes),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["nodes_a_cell"] =
        static_cast<double>(nodes) / (size * surface.samples_per_metre);
}
BENCHMARK(BM_Splat)
    ->ArgsProduct({{64, 432, 2000, 16000}, {20, 200, 2000}})
    ->ArgNames({"nodes", "millimetres"});

void BM_SubstepRayleigh(benchmark::State& state) {
    substeps(state, Radiation::kRayleigh, Sampling::kSinc, 1);
}
BENCHMARK(BM_SubstepRayleigh);

void BM_SubstepPaper(benchmark::State& state) {
    substeps(state, Radiation::kPaper, Sampling::kPaper, 1);
}
BENCHMARK(BM_SubstepPaper);

/// A bowl's 96 modes, a view a millisecond, at so many metres: where modes are inaudible they cost
/// nothing. The error is what is left out, at the nearest ear.
void BM_Modes(benchmark::State& state) {
    constexpr std::size_t kModes = 96;
    constexpr double kStep = 1e-3, kRate = 1e-3; // [s], [m/s] of each mode's greatest displacement
    const Shape shape = make_torus(36, 12);
    BoundaryMesh mesh;
    mesh.node = shape.node;
    for (std::size_t t = 0; t + 2 < shape.triangle.size(); t += 3)
        mesh.triangle.push_back({shape.triangle[t], shape.triangle[t + 1], shape.triangle[t + 2]});
    std::vector<double> omega, decay(kModes, 1.0), form;
    for (std::size_t k = 0; k < kModes; ++k) {
        omega.push_back(kTau * (500.0 + 200.0 * static_cast<double>(k)));
        for (const Vec3& x : shape.node)
            for (int axis = 0; axis < 3; ++axis)
                form.push_back(std::cos(30.0 * x.x() + static_cast<double>(k) * x.y() + axis));
    }
    Settings settings;
    const std::shared_ptr<const ModalVoiceModel> model =
        make_voice_model(omega, decay, mesh, form, settings);
    Scene scene;
    scene.set(settings);
    scene.add_listener(0.0).pose.centre = {0.0, 0.0, static_cast<double>(state.range(0))};
    std::vector<double> amplitude(kModes, 0.0), rate(kModes, kRate);
    double t = 0.0;
    for (auto _ : state) {
        t += kStep;
        for (std::size_t k = 0; k < kModes; ++k) {
            amplitude[k] = kRate / omega[k] * std::sin(omega[k] * t);
            rate[k] = kRate * std::cos(omega[k] * t);
        }
        scene.push(&shape, shape.triangle,
                   ModalView{t, kStep, amplitude, rate, Vec3::Zero(), Eigen::Matrix3d::Identity()},
                   [&] { return model; });
        scene.end_step(t);
    }
    const Scene::Count count = scene.count();
    const double left_out = static_cast<double>(count.inaudible_samples) /
                            static_cast<double>(count.inaudible_samples + count.mode_samples);
    state.counters["left_out"] = left_out;
    state.counters["error_Pa"] = left_out * kModes * kInaudible; // at most
}
BENCHMARK(BM_Modes)->Arg(1)->Arg(100)->Arg(10000)->Arg(1000000)->ArgName("metres");

/// Level [dB] of a point source of `frequency`, and of what else is heard, in counters.
void BM_Response(benchmark::State& state) {
    const auto frequency = static_cast<double>(state.range(0));
    const double radius = 2e-4, stroke = 1e-5, distance = 0.5;
    Settings settings = Rig::unit_settings();
    settings.sampling = state.range(1) ? Sampling::kPaper : Sampling::kSinc;
    double level = 0.0, rest = 0.0;
    for (auto _ : state) {
        Rig rig(settings, 0.6e-6);
        const Shape shape = make_sphere(1);
        rig.listener->pose.centre = {0.0, 0.0, distance};
        rig.listener->pose.ear_distance = 0.0;
        rig.add(shape, pulsate(radius, stroke, frequency));
        rig.run(0.1);
        const std::vector<double> out = rig.heard(0.02, 0.09);
        const double expected = Air{}.density * kTau * frequency *
                                flow_amplitude(shape, radius, stroke, frequency) /
                                (2.0 * kTau * distance);
        level = decibel(std::abs(phasor(out, rig.rate(), frequency)) / expected);
        rest = decibel(band_rms(out, rig.rate(), 20.0, 20000.0) * std::numbers::sqrt2 / expected);
    }
    state.counters["level_dB"] = level;
    state.counters["in_band_dB"] = rest; // of an ultrasonic source: its alias
}
BENCHMARK(BM_Response)
    ->ArgsProduct({{1000, 10000, 15000, 20000, 24500, 28100, 47000, 71000, 101000, 200000}, {0, 1}})
    ->ArgNames({"hertz", "paper"})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace ode::sound::test

BENCHMARK_MAIN();
