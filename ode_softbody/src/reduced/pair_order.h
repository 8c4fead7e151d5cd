#pragma once

#include <cstddef>

namespace ode::soft {

/// The products q_i q_j, i <= j, of some amplitudes in a row: by rising j, then by rising i. Those
/// of the first few modes come first, so that the monomials q_i q_j q_k q_l with sorted indices
/// are, for each pair (k, l), a beginning of the row of pairs (i, j); and fewer modes leave a
/// beginning of that.
struct PairOrder {
    std::size_t modes = 0;

    /// Of so many modes.
    static constexpr std::size_t count(std::size_t modes) noexcept {
        return modes * (modes + 1) / 2;
    }
    std::size_t count() const noexcept { return count(modes); }
    static constexpr std::size_t at(std::size_t i, std::size_t j) noexcept {
        return i <= j ? count(j) + i : at(j, i);
    }
};

} // namespace ode::soft
