#include "bench/coupling/coupling_table.h"
#include "bench/coupling/tet_filters.h"
#include "support/thrown_cubes.h"

#include <cmath>

namespace ode::soft {

Table soft_pair_table(bool brief) {
    constexpr double kMean = 0.5;      // [%]
    constexpr double kGain = 1;        // [%]
    constexpr double kMomentum = 1e-6; // relative
    Table table("soft pairs", {"two soft cubes thrown at each other", "critical step",
                               "energy, mean %", "worst %", "highest %", "momentum", "angular",
                               "us/substep while near", "tests/substep"});
    const unsigned throws = brief ? 4 : 12;
    for (const double share : {0.7, 0.45, 0.1})
        for (const bool by_volume : {false, true}) {
            if (brief && share < 0.4)
                continue;
            ThrowOutcome all{};
            double mean = 0;
            for (unsigned seed = 0; seed < throws; ++seed) {
                const ThrowOutcome o =
                    throw_cubes({.seed = seed, .share = share, .by_volume = by_volume});
                mean += std::fabs(o.change) / throws;
                all.change = std::fmin(all.change, o.change);
                all.highest = std::fmax(all.highest, o.highest);
                all.momentum = std::fmax(all.momentum, o.momentum);
                all.angular = std::fmax(all.angular, o.angular);
                all.seconds += o.seconds;
                all.near_substeps += o.near_substeps;
                all.tally.tests += o.tally.tests;
            }
            table.add({by_volume ? "volume" : "closest point",
                       {"%.2f", share},
                       {"%.2f", 100 * mean, kMean},
                       {"%.2f", 100 * all.change},
                       {"%+.2f", 100 * all.highest, kGain},
                       {"%.0e", all.momentum, kMomentum},
                       {"%.0e", all.angular, kMomentum},
                       {"%.1f", 1e6 * all.seconds / all.near_substeps},
                       {"%.0f", static_cast<double>(all.tally.tests) / all.near_substeps}});
        }
    return table;
}

Table filter_table(bool brief) {
    Table table("filters", {"filter of tetrahedra", "ns/pair", "pairs kept, %",
                            "of these overlap, %", "overlaps missed"});
    for (const FilterRow& row : compare_filters(brief ? 2000 : 20000))
        table.add({row.name,
                   {"%.0f", row.nanoseconds},
                   {"%.1f", 100 * row.kept},
                   {"%.1f", 100 * row.right},
                   {"%.0f", static_cast<double>(row.missed), 0}});
    return table;
}

} // namespace ode::soft
