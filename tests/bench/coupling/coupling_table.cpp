#include "bench/coupling/coupling_table.h"

#include <ostream>

namespace ode::soft {

void print_coupling_table(std::ostream& out) {
    print_island_rows(out);
    out << '\n';
    print_pile_rows(out);
    out << '\n';
    print_soft_pair_rows(out, false);
}

} // namespace ode::soft
