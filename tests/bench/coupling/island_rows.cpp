#include "bench/coupling/coupling_table.h"
#include "support/coupling_cases.h"

#include <algorithm>

namespace ode::soft {

Table island_table(bool brief) {
    constexpr double kMark = 1e-3;
    Table table("islands", {"jointed bodies", "h, ms", "impulse", "peak force", "energy",
                            "path, um", "of mm", "CPU s: library", "reference"});
    std::vector<test::CouplingCase> cases = test::coupling_cases();
    for (const double ratio : {1e-2, 1e-1, 1.0, 1e1, 1e2})
        if (!brief || ratio == 1)
            cases.push_back(test::mass_ratio_case(ratio));
    for (const test::CouplingCase& c : cases) {
        const test::CouplingRun truth = test::run_reference(c);
        for (const double h : {1e-3, 16e-3 / 3, 16e-3}) {
            if (brief && h != 16e-3 / 3)
                continue;
            const test::CouplingRun run = test::run_library(c, h);
            double path = 0;
            for (std::size_t i = 0; i < std::min(run.path.size(), truth.path.size()); ++i)
                path = std::max(path, (run.path[i] - truth.path[i]).norm());
            table.add(
                {c.name,
                 {"%.3g", 1e3 * h},
                 {"%+.1e", run.impulse.norm() / truth.impulse.norm() - 1, kMark},
                 {"%+.1e", run.peak / truth.peak - 1, kMark},
                 {"%+.1e", (run.energy_after - truth.energy_after) / truth.energy_before, kMark},
                 {"%.1f", 1e6 * path},
                 {"%.0f", 1e3 * truth.length},
                 {"%.2f", run.seconds},
                 {"%.2f", truth.seconds}});
        }
    }
    return table;
}

} // namespace ode::soft
