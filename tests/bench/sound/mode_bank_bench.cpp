// Cost of the mode bank a mode and audio sample (two samples of the grid that voices run on), with
// what its floats err by: rows of oscillators rung, and weighed for two ears. Mark: 0.2 ns.
#include "dsp/kernels.h"
#include "dsp/storage.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace ode::sound {
namespace {

constexpr double kGrid = 96000.0; // [Hz]
constexpr int kBlock = 32;

using Row = AlignedFloats;

struct Bank {
    explicit Bank(int n) : columns(n) {
        for (Row* row : {&q, &v, &by_q, &by_v})
            row->assign(static_cast<std::size_t>(n), 0.0f);
        step.assign(4 * static_cast<std::size_t>(n), 0.0f);
        q_rows.assign(static_cast<std::size_t>(n) * kBlock, 0.0f);
        v_rows = q_rows;
        for (int k = 0; k < n; ++k) {
            const auto i = static_cast<std::size_t>(k), all = static_cast<std::size_t>(n);
            const double w = omega(k), d = decay(k), wd = std::sqrt(w * w - d * d), t = 1.0 / kGrid;
            const double fade = std::exp(-d * t), c = std::cos(wd * t), s = std::sin(wd * t) / wd;
            // cos - 1 without what cancels.
            const double less = std::expm1(-d * t) * c - 2.0 * std::pow(std::sin(wd * t / 2), 2);
            step[i] = static_cast<float>(less + fade * d * s);
            step[all + i] = static_cast<float>(fade * s);
            step[2 * all + i] = static_cast<float>(-fade * w * w * s);
            step[3 * all + i] = static_cast<float>(less - fade * d * s);
            v[i] = static_cast<float>(w);
            by_q[i] = by_v[i] = 1.0f / static_cast<float>(n);
        }
    }
    double omega(int k) const {
        return 2.0 * std::numbers::pi * 50.0 * std::pow(400.0, (k + 0.5) / columns);
    }
    double decay(int k) const { return 0.5 + 1e-8 * omega(k) * omega(k); }

    int columns;
    Row q, v, step, by_q, by_v, q_rows, v_rows;
};

void bank(benchmark::State& state, const Kernels& set, int ears) {
    Bank b(static_cast<int>(state.range(0)));
    float left[kBlock], right[kBlock];
    float* const out[] = {left, right};
    const float* const by[][2] = {{b.by_q.data(), b.by_v.data()}, {b.by_v.data(), b.by_q.data()}};
    const Bank fresh(b.columns);
    long samples = 0;
    for (auto _ : state) {
        set.ring(b.columns, kBlock, b.step.data(), b.columns, b.q.data(), b.v.data(),
                 b.q_rows.data(), b.v_rows.data());
        if (ears > 0)
            set.weigh(b.columns, kBlock, ears, by, b.q_rows.data(), b.v_rows.data(), out);
        benchmark::DoNotOptimize(left);
        benchmark::DoNotOptimize(right);
        samples += kBlock;
        if (samples % 96000 == 0) // or it would die away into denormal numbers
            std::copy(fresh.v.begin(), fresh.v.end(), b.v.begin());
    }
    state.counters["ns_mode_audio_sample"] =
        benchmark::Counter(0.5 * static_cast<double>(samples) * b.columns * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    // After a second: cents, decay and level of the worst mode.
    Bank error(64);
    for (long n = 0; n < 96000; n += kBlock)
        set.ring(error.columns, kBlock, error.step.data(), error.columns, error.q.data(),
                 error.v.data(), error.q_rows.data(), error.v_rows.data());
    double worst = 0.0;
    for (int k = 0; k < error.columns; ++k) {
        const double w = error.omega(k), d = error.decay(k), wd = std::sqrt(w * w - d * d);
        const double fade = std::exp(-d);
        if (fade < 1e-6)
            continue;
        const double q = fade * std::sin(wd) * w / wd;
        worst = std::max(
            worst, std::fabs(static_cast<double>(error.q[static_cast<std::size_t>(k)]) - q) / fade);
    }
    state.counters["worst_relative"] = worst;
}

int register_all() {
    for (const Kernels* set : all_kernels())
        for (const int ears : {0, 2})
            benchmark::RegisterBenchmark(
                ("bank/" + std::string(set->name) + "/ears:" + std::to_string(ears)).c_str(),
                [set, ears](benchmark::State& state) { bank(state, *set, ears); })
                ->Arg(64)
                ->Arg(512);
    return 0;
}
const int kRegistered = register_all();

} // namespace
} // namespace ode::sound
