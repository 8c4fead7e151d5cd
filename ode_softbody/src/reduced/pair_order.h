#pragma once

#include <cstddef>

namespace ode::soft {

/// The products q_i q_j, i <= j, of some amplitudes in a row: by falling i, then by rising j. Those
/// whose lesser index is j or more come first, so that the monomials q_i q_j q_k q_l with sorted
/// indices are, for each pair (i, j), a beginning of the row of pairs (k, l).
struct PairOrder {
    std::size_t modes = 0;

    /// How many have no index below `least`.
    std::size_t count(std::size_t least = 0) const noexcept {
        return (modes - least) * (modes - least + 1) / 2;
    }
    std::size_t at(std::size_t i, std::size_t j) const noexcept {
        return i <= j ? count(i + 1) + j - i : at(j, i);
    }
};

} // namespace ode::soft
