#include "base/error.h"
#include "bench/coupling/coupling_table.h"
#include "support/coupling_cases.h"

#include <algorithm>
#include <ostream>

namespace ode::soft {

void print_island_rows(std::ostream& out) {
    out << "| jointed bodies | h, ms | impulse | peak force | energy | path, um of mm | CPU s: "
           "library, "
           "reference |\n|---|---|---|---|---|---|---|\n";
    std::vector<test::CouplingCase> cases = test::coupling_cases();
    for (const double ratio : {1e-2, 1e-1, 1.0, 1e1, 1e2})
        cases.push_back(test::mass_ratio_case(ratio));
    for (const test::CouplingCase& c : cases) {
        const test::CouplingRun truth = test::run_reference(c);
        for (const double h : {1e-3, 16e-3 / 3, 16e-3}) {
            const test::CouplingRun run = test::run_library(c, h);
            double path = 0;
            for (std::size_t i = 0; i < std::min(run.path.size(), truth.path.size()); ++i)
                path = std::max(path, (run.path[i] - truth.path[i]).norm());
            out << "| " << c.name
                << format(" | %.3g | %+.1e | %+.1e | %+.1e | %.1f of %.0f | %.2f, %.2f |\n",
                          1e3 * h, run.impulse.norm() / truth.impulse.norm() - 1,
                          run.peak / truth.peak - 1,
                          (run.energy_after - truth.energy_after) / truth.energy_before, 1e6 * path,
                          1e3 * truth.length, run.seconds, truth.seconds);
        }
    }
}

} // namespace ode::soft
