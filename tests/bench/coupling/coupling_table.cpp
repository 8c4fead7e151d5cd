#include "bench/coupling/coupling_table.h"

#include <ostream>

namespace ode::soft {

void print_coupling_table(std::ostream& out) {
    print_island_rows(out);
    out << '\n';
    print_pile_rows(out);
}

} // namespace ode::soft
