#pragma once

#include <vector>

namespace ode::soft {

struct FilterRow {
    const char* name;
    double nanoseconds; ///< a pair
    double kept;        ///< share of pairs that it lets pass
    double right;       ///< share of those that overlap
    long missed;        ///< overlaps that it dropped
};

/// Pairs of tetrahedra of 1 cm whose boxes overlap, through each filter and through the overlap
/// itself. libccd runs guarded: shapes blown up to a metre, iterations limited, GJK's yes or no
/// alone, since its EPA loops and MPR errs.
std::vector<FilterRow> compare_filters(int pairs);

} // namespace ode::soft
