// A heap of soft and rigid bodies falls into a bin and comes to rest: cost per step by phase, what
// it does per step, and energy beside it. bench_pile [soft] [rigid] [seconds]
#include "scenes/pile.h"

#include <ode_softbody/softbody.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

constexpr double kStep = 1.0 / 240;

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

dSoftWorldStats stats_of(dSoftWorldID world) {
    dSoftWorldStats stats{};
    stats.struct_size = sizeof stats;
    dSoftWorldGetStats(world, &stats);
    return stats;
}

} // namespace

int main(int count, char** argument) {
    const auto number = [&](int i, double usual) {
        return count > i ? std::atof(argument[i]) : usual;
    };
    dInitODE2(0);
    {
        scenes::World world;
        scenes::Pile pile;
        pile.soft = static_cast<int>(number(1, 100));
        pile.rigid = static_cast<int>(number(2, 20));
        pile.may_rest = true;
        const scenes::PileBodies bodies = build(world, pile);
        const double first = look_at(bodies, 9.81).energy();
        double highest = first;
        std::printf(
            "%zu soft and %zu rigid bodies, steps of %.4g ms\n\n"
            "| time, s | CPU ms/step | substeps/step | bodies/substep | pairs/substep | "
            "tests/substep | "
            "points/substep | energy, J | fastest, m/s |\n|---|---|---|---|---|---|---|---|---|\n",
            bodies.soft.size(), bodies.rigid.size(), 1e3 * kStep);
        const int steps = static_cast<int>(number(3, 8) / kStep);
        constexpr int kEvery = 60;
        dSoftWorldStats before = stats_of(world.soft());
        double start = cpu_seconds();
        for (int i = 1; i <= steps; ++i) {
            world.step(kStep);
            if (i % kEvery != 0)
                continue;
            const double spent = cpu_seconds() - start;
            const dSoftWorldStats now = stats_of(world.soft());
            const auto substeps = static_cast<double>(now.substeps - before.substeps);
            const auto each = [&](unsigned long a, unsigned long b) {
                return substeps > 0 ? static_cast<double>(a - b) / substeps : 0;
            };
            const scenes::PileState state = look_at(bodies, 9.81);
            highest = std::max(highest, state.energy());
            std::printf(
                "| %.2f | %.2f | %.1f | %.0f | %.0f | %.0f | %.0f | %.3f | %.1e |\n", i * kStep,
                1e3 * spent / kEvery, substeps / kEvery,
                each(now.body_substeps, before.body_substeps),
                each(now.soft_pairs, before.soft_pairs),
                each(now.contact_tests + now.soft_tests, before.contact_tests + before.soft_tests),
                each(now.contact_points, before.contact_points), state.energy(), state.fastest);
            before = now;
            start = cpu_seconds();
        }
        const scenes::PileState last = look_at(bodies, 9.81);
        std::printf(
            "\nenergy at most %+.2e of the first; middles at least %.3f m above the floor, at "
            "most %.3f of %.3f m aside, %.3f m apart; stopped: %s\n",
            highest / first - 1, last.lowest, last.widest, bodies.half, last.closest,
            last.any_stopped ? "some" : "none");
    }
    dCloseODE();
}
