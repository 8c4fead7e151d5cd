#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace ode::soft {

/// Registers of this many single numbers, on every set of instructions: sums are the same.
inline constexpr std::size_t kRowLanes = 16;
inline constexpr std::size_t kRowsAtOnce = 4;

/// Up to four rows of coefficients, one after another. `registers` of each are used.
struct RowBlock {
    std::size_t offset;              ///< of the first row's coefficients [floats]
    std::uint32_t stride, registers; ///< from row to row; that are used [registers]
    std::uint32_t rows;
};

/// Both halves of a quadratic form's gradient from one reading of its coefficients:
/// answer_r = row_r . product, sum += by_r row_r, r through the rows of all blocks.
/// @param answer  room for kRowsAtOnce more than there are rows
using AddRows = void (*)(const float* coefficient, std::span<const RowBlock> blocks,
                         const float* by, const float* product, float* answer, float* sum);

/// For the instructions in use (base/isa.h).
AddRows add_rows_kernel() noexcept;

} // namespace ode::soft
