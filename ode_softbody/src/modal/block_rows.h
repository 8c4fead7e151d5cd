#pragma once

#include "modal/block_system.h"

namespace ode::soft {

/// y = K x over `lanes` adjacent vectors, whose sums stay in registers. The same arithmetic in the
/// same order at any width, and no fused operations: equal bits.
template <typename T, int lanes>
[[gnu::always_inline]] inline void stiffness_rows(const BlockSystem& s, const T* stiffness,
                                                  const T* x, T* y, std::size_t stride) {
    const std::size_t nodes = s.node_count();
    for (std::size_t i = 0; i < nodes; ++i) {
        T sum[3][lanes] = {};
        for (int p = s.start[i]; p < s.start[i + 1]; ++p) {
            const T* k = stiffness + 9 * static_cast<std::size_t>(p);
            const T* from =
                x + 3 * stride * static_cast<std::size_t>(s.column[static_cast<std::size_t>(p)]);
            for (int c = 0; c < 3; ++c, from += stride)
                for (int v = 0; v < lanes; ++v) {
                    sum[0][v] += k[c] * from[v];
                    sum[1][v] += k[3 + c] * from[v];
                    sum[2][v] += k[6 + c] * from[v];
                }
        }
        T* to = y + 3 * stride * i;
        for (int r = 0; r < 3; ++r, to += stride)
            for (int v = 0; v < lanes; ++v)
                to[v] = sum[r][v];
    }
}

/// Hands all columns of a block of vectors to kernels of 16, 8, 4, 2 and 1 lanes, widest first:
/// each pass streams the whole matrix.
/// @param pass  pass(lanes as integral_constant, first column)
template <typename Pass>
void in_lanes(std::size_t columns, const Pass& pass) {
    std::size_t v = 0;
    const auto take = [&]<int lanes>(std::integral_constant<int, lanes> width) {
        for (; v + lanes <= columns; v += lanes)
            pass(width, v);
    };
    take(std::integral_constant<int, 16>());
    take(std::integral_constant<int, 8>());
    take(std::integral_constant<int, 4>());
    take(std::integral_constant<int, 2>());
    take(std::integral_constant<int, 1>());
}

} // namespace ode::soft
