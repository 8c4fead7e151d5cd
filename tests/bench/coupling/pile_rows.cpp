#include "base/error.h"
#include "bench/coupling/coupling_table.h"
#include "support/pile_cases.h"

#include <ostream>

namespace ode::soft {

void print_pile_rows(std::ostream& out) {
    out << "| pile at rest on a plate | h, ms | mean load, N (weight) | ripple, of the weight | "
           "CPU s "
           "|\n|---|---|---|---|---|\n";
    constexpr struct {
        test::Pile pile;
        const char* name;
    } kPiles[] = {{test::Pile::box, "1 kg"},
                  {test::Pile::stack, "1 kg on 0.1 kg"},
                  {test::Pile::three, "1 kg on 0.3 kg on 0.1 kg"}};
    for (const auto& [pile, name] : kPiles)
        for (const double h : {1e-3, 5e-3, 16e-3}) {
            const test::PileRun run = test::run_pile(pile, h, 1e-3, 0.6);
            out << "| " << name
                << format(" | %g | %.4f (%.4f) | %.1e | %.2f |\n", 1e3 * h, run.mean, run.weight,
                          run.ripple / run.weight, run.seconds);
        }
}

} // namespace ode::soft
