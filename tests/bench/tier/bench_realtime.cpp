// softsound bench realtime: what a bowl costs in each tier, and how far its waveform is from the
// explicit one's.
#include "physics/tier/tier_run.h"

#include "base/thread_pool.h"

#include <CLI/CLI.hpp>

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <span>

namespace {

using namespace ode::soft;

constexpr double kGravity = 9.81;

const char* name_of(TierChoice tier) {
    return std::find_if(std::begin(kTierNames), std::end(kTierNames),
                        [&](const TierName& t) { return t.choice == tier; })
        ->name.data();
}

struct Outcome {
    double cpu = 0;                          ///< s a simulated s, after the first step
    std::vector<AlignedVector<double>> rate; ///< of each mode, step by step
    std::shared_ptr<const ModalBasis> basis;
};

struct Scene {
    const char* name;
    double height;   ///< of the lowest node over the floor [m]
    double speed;    ///< down [m/s]
    double step;     ///< of ODE [s]
    double seconds;  ///< simulated
    double compared; ///< of it, against the explicit run [s]
    double look;     ///< step while they are compared [s]
};

/// @param basis  what motion is compared by; null: nothing is
Outcome run(const Scene& scene, int order, TierChoice tier, double seconds,
            const std::shared_ptr<const ModalBasis>& basis) {
    TierRun run(tier, order, scene.height > 0 ? -kGravity : 0.0);
    Body& body = run.body();
    if (scene.height > 0)
        throw_down(run, scene.height, scene.speed);
    constexpr double kPulse = 3e-4, kFine = 1e-5;
    for (double t = kFine / 2; scene.height == 0 && t < kPulse; t += kFine) { // rings in flight
        const double phase = 2 * std::numbers::pi * t / kPulse;
        body.add_force(0, {0, 0, 150 * (1 - std::cos(phase))});
        run.step(kFine);
    }
    Outcome out;
    run.step(scene.step); // finds modes, once for all bodies of a kind
    const double first = run.seconds();
    for (double t = scene.step; t < seconds - scene.step / 2; t += scene.step) {
        run.step(scene.step);
        if (basis)
            out.rate.push_back(audible(body, basis));
    }
    out.cpu = (run.seconds() - first) / (seconds - scene.step);
    if (body.rings())
        out.basis = body.modal_motion()->shared_basis();
    return out;
}

void print_scene(const Scene& scene, int order, double share) {
    const auto modes = run(scene, order, TierChoice::modes, scene.step * 2, nullptr);
    const double compared = order == 1 ? scene.compared : scene.compared / 5;
    Scene closely = scene;
    closely.step = scene.look;
    const Outcome nodes = run(closely, order, TierChoice::explicit_space, compared, modes.basis);
    std::printf("| %s | %d | explicit | %.3g | %.3g | reference |\n", scene.name, order, nodes.cpu,
                1 / nodes.cpu);
    for (const TierChoice tier : {TierChoice::modes, TierChoice::cubic, TierChoice::automatic}) {
        const Outcome like = run(closely, order, tier, compared, modes.basis);
        const Outcome timed =
            run(scene, order, tier, std::max(compared, share * scene.seconds), nullptr);
        std::printf("| %s | %d | %s | %.3g | %.1f | %.2f %% |\n", scene.name, order, name_of(tier),
                    timed.cpu, 1 / timed.cpu, 100 * audible_error(like.rate, nodes.rate));
        std::fflush(stdout);
    }
}

/// Modes carried over one step a sample at 48 kHz.
void print_bank() {
    for (const std::size_t modes : {std::size_t{96}, std::size_t{1024}, std::size_t{100000}}) {
        std::vector<double> omega(modes / 8 * 8), decay(omega.size(), 1.0);
        for (std::size_t k = 0; k < omega.size(); ++k)
            omega[k] = 100.0 + static_cast<double>(k);
        Oscillators bank(omega, decay);
        std::vector<double> q(omega.size(), 1.0), v(omega.size(), 0.0);
        bank.advance(1 / 48e3, q, v);
        double best = 1;
        const int samples = static_cast<int>(2000000 / modes) + 1;
        for (int repeat = 0; repeat < 20; ++repeat) {
            const double before = cpu_seconds();
            for (int i = 0; i < samples; ++i)
                bank.advance(1 / 48e3, q, v);
            best = std::min(best, (cpu_seconds() - before) / samples);
        }
        std::printf("| %zu modes, double | %.3f | %.0f |\n", omega.size(),
                    1e9 * best / static_cast<double>(omega.size()),
                    static_cast<double>(omega.size()) / (48e3 * best));
    }
}

/// Like bodies in flight, a step of 1 ms.
void print_bodies(std::span<const int> counts) {
    for (const int count : counts) {
        TierRun run(TierChoice::modes, 1, -kGravity);
        run.body().move_to({0, 0, 10});
        for (int i = 1; i < count; ++i) {
            Body& twin = run.world().create_body(run.body().mesh(), run.body().solids());
            twin.set_tier(TierChoice::modes);
            twin.move_to({0.3 * (i % 32), 0.3 * (i / 32), 10});
        }
        run.step(1e-3);
        const double first = run.seconds();
        for (int i = 0; i < 50; ++i)
            run.step(1e-3);
        std::printf("| %d | %.3f | %.2f |\n", count, (run.seconds() - first) / 0.05,
                    1e6 * (run.seconds() - first) / 50 / count);
    }
}

std::size_t heap_bytes() {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

/// Cubes of n^3 cells of six elements, node by node: a substep, and all that a body holds.
void print_elements(std::span<const int> cells) {
    for (const int n : cells) {
        const double size = 0.01 * n;
        const std::size_t before = heap_bytes();
        TierRun run(make_box({size, size, size}, n, n, n), TierChoice::explicit_space, 1, 0);
        run.body().add_force(0, {1, 0, 0});
        const double substep = run.body().substep();
        run.step(4 * substep);
        const auto elements = static_cast<double>(run.body().mesh().element_count());
        const int substeps = std::max(8, static_cast<int>(2e6 / elements));
        const double first = run.seconds();
        run.step(substeps * substep);
        std::printf("| %.0f | %.1f | %.0f |\n", elements,
                    1e9 * (run.seconds() - first) / substeps / elements,
                    static_cast<double>(heap_bytes() - before) / elements);
        std::fflush(stdout);
    }
}

struct Crowd {
    const char* name;
    TetMesh mesh;
    int order;
    int bodies;
};

/// Node by node in flight, on one thread and on two: the least time of a step by the clock, steps
/// of both in turn.
void print_threads(std::span<const Crowd> crowds, int repeats) {
    using Clock = std::chrono::steady_clock;
    for (const Crowd& crowd : crowds) {
        std::unique_ptr<TierRun> run[2];
        double best[2] = {INFINITY, INFINITY};
        for (int t = 0; t < 2; ++t) {
            run[t] =
                std::make_unique<TierRun>(crowd.mesh, TierChoice::explicit_space, crowd.order, 0);
            run[t]->world().set_tasks(t == 1 ? std::make_unique<ThreadPool>(2) : nullptr);
            for (int i = 1; i < crowd.bodies; ++i) {
                Body& twin = run[t]->world().create_body(crowd.mesh, run[t]->body().solids());
                twin.set_form(run[t]->body().form());
                twin.move_to({0.3 * i, 0, 0});
            }
            run[t]->body().add_force(0, {1, 0, 0});
        }
        const double step = 50 * run[0]->body().substep();
        for (int i = 0; i < repeats; ++i)
            for (int t = 0; t < 2; ++t) {
                const auto start = Clock::now();
                run[t]->step(step);
                const double taken = std::chrono::duration<double>(Clock::now() - start).count();
                best[t] = std::min(best[t], taken);
            }
        const NodeState &one = run[0]->body().state(), &two = run[1]->body().state();
        const std::size_t bytes = sizeof(double) * NodeArray::kStride * one.position.size();
        const bool same = std::memcmp(one.position.data(), two.position.data(), bytes) == 0;
        std::printf("| %s | %.4g | %.4g | %.2f | %s |\n", crowd.name, 2e4 * best[0], 2e4 * best[1],
                    best[0] / best[1], same ? "none, bit for bit" : "NOT THE SAME");
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Run time of the tiers, each with its waveform error; a minute");
    bool brief = false;
    app.add_flag("--brief", brief, "Linear elements and short runs only");
    CLI11_PARSE(app, argc, argv);
    dInitODE2(0);
    const Scene scenes[] = {{"rings in flight", 0, 0, 1e-3, 2.0, 0.02, 1e-3},
                            {"falls and bounces", 0.001, 1.0, 1e-3, 2.0, 0.03, 1e-4}};
    std::printf("Bowl, 434 nodes of linear or 2451 of quadratic elements, 1152 elements\n\n"
                "| scene | order | tier | CPU s/s | x real time | waveform error |\n"
                "|---|---|---|---|---|---|\n");
    for (const Scene& scene : scenes)
        for (const int order : {1, 2})
            if (order == 1 || !brief)
                print_scene(scene, order, brief ? 0.1 : 1);
    std::printf("\n| bank | ns a mode-sample | modes in real time on a core |\n|---|---|---|\n");
    print_bank();
    std::printf("\n| bowls in flight | CPU s/s | us a body and step |\n|---|---|---|\n");
    constexpr int kAll[] = {1, 10, 100, 1000};
    print_bodies(brief ? std::span(kAll).first(2) : std::span(kAll));
    std::printf("\n| linear elements, explicit | ns an element and substep | bytes an element |\n"
                "|---|---|---|\n");
    constexpr int kCells[] = {6, 12, 26, 55};
    print_elements(brief ? std::span(kCells).first(2) : std::span(kCells));
    const TetMesh bowl = make_bowl(0.1, 0.005, 1.4, 8, 48, 1);
    const TetMesh cube = make_box({0.2, 0.2, 0.2}, 20, 20, 20);
    const Crowd crowds[] = {{"bowl, 1152 linear elements", bowl, 1, 1},
                            {"bowl, 1152 quadratic elements", bowl, 2, 1},
                            {"cube, 48000 linear elements", cube, 1, 1},
                            {"cube, 48000 quadratic elements", cube, 2, 1},
                            {"16 bowls of linear elements", bowl, 1, 16}};
    std::printf("\n| explicit | us a substep, 1 thread | 2 threads | ratio | difference |\n"
                "|---|---|---|---|---|\n");
    print_threads(brief ? std::span(crowds).first(2) : std::span(crowds), brief ? 3 : 30);
    return 0;
}
