// softsound bench realtime: what a bowl costs in each tier, and how far its waveform is from the
// explicit one's.
#include "physics/tier/tier_run.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
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
    unsigned long substeps = 0, modal = 0;
};

struct Scene {
    const char* name;
    double height;   ///< of the lowest node over the floor [m]
    double speed;    ///< down [m/s]
    double step;     ///< of ODE [s]
    double seconds;  ///< simulated
    double compared; ///< of it, against the explicit run [s]
};

/// @param basis  what motion is compared by; null: nothing is
Outcome run(const Scene& scene, int order, TierChoice tier, double seconds,
            const std::shared_ptr<const ModalBasis>& basis) {
    TierRun run(tier, order, scene.height > 0 ? -kGravity : 0.0);
    Body& body = run.body();
    if (scene.height > 0) {
        dCreatePlane(run.space(), 0, 0, 1, 0);
        body.rotate(Quat(Eigen::AngleAxisd(0.4, Vec3(1, 0.3, 0).normalized())));
        double low = 1;
        for (std::size_t i = 0; i < body.mass().size(); ++i)
            low = std::min(low, body.state().position[i].z());
        body.move_to(body.center_of_mass() + Vec3(0, 0, scene.height - low));
        body.set_velocity({0, 0, -scene.speed});
    }
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
        if (!basis)
            continue;
        ModalMotion seen(basis);
        seen.take(body.state(), {});
        // Of amplitudes, not of their rates: the explicit velocity lags by half a substep.
        AlignedVector<double> swing = seen.state().amplitude;
        for (std::size_t k = 0; k < swing.size(); ++k)
            swing[k] *= basis->omega[k];
        out.rate.push_back(std::move(swing));
    }
    out.cpu = (run.seconds() - first) / (seconds - scene.step);
    if (body.rings())
        out.basis = body.modal_motion()->shared_basis();
    out.substeps = run.world().stats().substeps;
    out.modal = run.world().stats().modal_substeps;
    return out;
}

/// Relative L2 of all that is below 22 kHz.
double error(const Outcome& of, const Outcome& reference) {
    double off = 0, all = 0;
    for (std::size_t t = 0; t < reference.rate.size(); ++t)
        for (std::size_t k = 0; k < reference.rate[t].size(); ++k) {
            off += std::pow(of.rate[t][k] - reference.rate[t][k], 2);
            all += std::pow(reference.rate[t][k], 2);
        }
    return std::sqrt(off / all);
}

void print_scene(const Scene& scene, int order, double share) {
    const auto modes = run(scene, order, TierChoice::modes, scene.step * 2, nullptr);
    const double compared = order == 1 ? scene.compared : scene.compared / 10;
    const Outcome nodes = run(scene, order, TierChoice::explicit_space, compared, modes.basis);
    std::printf("| %s | %d | explicit | %.3g | %.3g | reference |\n", scene.name, order, nodes.cpu,
                1 / nodes.cpu);
    for (const TierChoice tier : {TierChoice::modes, TierChoice::automatic}) {
        const Outcome like = run(scene, order, tier, compared, modes.basis);
        const Outcome timed =
            run(scene, order, tier,
                std::max(compared, (tier == TierChoice::automatic && order == 2 ? 0.05 : 1.0) *
                                       share * scene.seconds),
                nullptr);
        std::printf("| %s | %d | %s | %.3g | %.1f | %.2f %% |\n", scene.name, order, name_of(tier),
                    timed.cpu, 1 / timed.cpu, 100 * error(like, nodes));
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

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Run time of the tiers, each with its waveform error; half a minute");
    bool brief = false;
    app.add_flag("--brief", brief, "Linear elements and short runs only");
    CLI11_PARSE(app, argc, argv);
    dInitODE2(0);
    const Scene scenes[] = {{"rings in flight", 0, 0, 1e-3, 2.0, 0.02},
                            {"falls and bounces", 0.001, 1.0, 1e-3, 2.0, 0.03}};
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
    return 0;
}
