#include "bench/coupling/coupling_table.h"
#include "support/pile_cases.h"

namespace ode::soft {

Table pile_table(bool brief) {
    constexpr double kMark = 0.01;
    Table table("piles", {"pile at rest on a plate", "h, ms", "mean load, N", "weight, N",
                          "ripple, of the weight", "CPU s"});
    constexpr struct {
        test::Pile pile;
        const char* name;
    } kPiles[] = {{test::Pile::box, "1 kg"},
                  {test::Pile::stack, "1 kg on 0.1 kg"},
                  {test::Pile::three, "1 kg on 0.3 kg on 0.1 kg"}};
    for (const auto& [pile, name] : kPiles)
        for (const double h : {1e-3, 5e-3, 16e-3}) {
            if (brief && (h != 5e-3 || pile == test::Pile::three))
                continue;
            const test::PileRun run = test::run_pile(pile, h, 1e-3, 0.6);
            table.add({name,
                       {"%g", 1e3 * h},
                       {"%.4f", run.mean},
                       {"%.4f", run.weight},
                       {"%.1e", run.ripple / run.weight, kMark},
                       {"%.2f", run.seconds}});
        }
    return table;
}

} // namespace ode::soft
