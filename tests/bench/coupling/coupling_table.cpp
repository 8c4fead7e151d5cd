#include "bench/coupling/coupling_table.h"

namespace ode::soft {

std::vector<Table> coupling_tables(bool brief) {
    return {island_table(brief), pile_table(brief), soft_rigid_table(brief), soft_pair_table(brief),
            filter_table(brief)};
}

} // namespace ode::soft
