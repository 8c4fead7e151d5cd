// Soft against soft: what each method keeps and costs, and the filters that could come before it.
#include "base/error.h"
#include "bench/coupling/coupling_table.h"
#include "bench/coupling/tet_filters.h"
#include "support/thrown_cubes.h"

#include <ostream>

namespace ode::soft {

void print_soft_pair_rows(std::ostream& out, bool brief) {
    out << "| two cubes thrown at each other | critical step | energy, mean | worst | highest | "
           "momentum, angular | us/substep while near | tests/substep |\n"
           "|---|---|---|---|---|---|---|---|\n";
    const unsigned throws = brief ? 4 : 12;
    for (const double share : {0.7, 0.45, 0.1})
        for (const bool by_volume : {false, true}) {
            if (brief && share < 0.4)
                continue;
            double mean = 0, worst = 0, highest = 0, momentum = 0, angular = 0, seconds = 0;
            double near = 0, tests = 0;
            for (unsigned seed = 0; seed < throws; ++seed) {
                const ThrowOutcome o =
                    throw_cubes({.seed = seed, .share = share, .by_volume = by_volume});
                mean += std::fabs(o.change) / throws;
                worst = std::fmin(worst, o.change);
                highest = std::fmax(highest, o.highest);
                momentum = std::fmax(momentum, o.momentum);
                angular = std::fmax(angular, o.angular);
                seconds += o.seconds;
                near += o.near_substeps;
                tests += static_cast<double>(o.tally.tests);
            }
            out << format(
                "| %s | %.2f | %.2f %% | %.2f %% | %+.2f %% | %.0e, %.0e | %.1f | %.0f |\n",
                by_volume ? "volume" : "closest point", share, 100 * mean, 100 * worst,
                100 * highest, momentum, angular, 1e6 * seconds / near, tests / near);
        }
    out << "\n| filter of tetrahedra | ns/pair | pairs kept | of these overlap | overlaps missed "
           "|\n|---|---|---|---|---|\n";
    for (const FilterRow& row : compare_filters(brief ? 2000 : 20000))
        out << format("| %s | %.0f | %.1f %% | %.1f %% | %ld |\n", row.name, row.nanoseconds,
                      100 * row.kept, 100 * row.right, row.missed);
}

} // namespace ode::soft
