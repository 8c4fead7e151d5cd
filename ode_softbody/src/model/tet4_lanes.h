#pragma once

#include "model/matrix_lanes.h"
#include "model/tet_kernel.h"

namespace ode::soft::ODE_SOFT_ISA {

/// Folds lanes into `range`; an energy that isn't finite makes all of it not-a-number, which min
/// and max would forget.
template <class L>
[[gnu::always_inline]] inline void widen(DeformationRange& range, typename L::Value least,
                                         typename L::Value most, typename L::Value energy) {
    double low[L::kWidth], high[L::kWidth], stored[L::kWidth];
    __builtin_memcpy(low, &least, sizeof low);
    __builtin_memcpy(high, &most, sizeof high);
    __builtin_memcpy(stored, &energy, sizeof stored);
    for (int i = 0; i < L::kWidth; ++i) {
        range.min_determinant = low[i] < range.min_determinant ? low[i] : range.min_determinant;
        range.max_trace = high[i] > range.max_trace ? high[i] : range.max_trace;
    }
    double sum = 0;
    for (int i = 0; i < L::kWidth; ++i)
        sum += stored[i];
    range.energy += sum;
    range.min_determinant += 0 * sum;
}

/// Three edge vectors from corner 0 as columns: Ds (P01 3.1).
template <class L>
[[gnu::always_inline]] inline void gather_edges(const double* base, const unsigned (*node)[4],
                                                typename L::Value (&edges)[3][3]) {
    unsigned at[4][L::kWidth];
    for (int i = 0; i < L::kWidth; ++i)
        for (int corner = 0; corner < 4; ++corner)
            at[corner][i] = node[i][corner];
    const auto origin = L::gather(base, at[0]);
    for (int j = 0; j < 3; ++j) {
        typename L::Value column[3];
        L::to_lanes(L::difference(L::gather(base, at[j + 1]), origin), column);
        for (int i = 0; i < 3; ++i)
            edges[i][j] = column[i];
    }
}

/// Packs that memory is asked for in advance: beyond the last-level cache the hardware's own
/// prefetch comes too late.
inline constexpr int kAhead = 4;

template <class Pack>
[[gnu::always_inline]] inline void prefetch(const Pack* pack) {
    for (std::size_t line = 0; line < sizeof(Pack); line += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(pack) + line);
}

/// Linear tetrahedra under the constitutive law `Law`, which turns F (and Fdot) into the first
/// Piola-Kirchhoff stress times volume, and adds the elastic energy. Forces are -V P Dm^-T on
/// corners 1..3 and minus their sum on corner 0, added element by element in the order of the list:
/// one order for all lane widths.
template <class L, class Law, bool kViscous>
void add_tet4_force(const void* packs, std::size_t count, const typename Law::Constants& constants,
                    const double* position, [[maybe_unused]] const double* velocity, double* force,
                    DeformationRange& range) {
    using Value = typename L::Value;
    const Tet4Pack* pack = static_cast<const Tet4Pack*>(packs);
    Value least = range.min_determinant + Value{};
    Value most = range.max_trace + Value{};
    Value energy{};
    for (const Tet4Pack* p = pack; p != pack + count; ++p) {
        prefetch(p + kAhead);
        for (int first = 0; first < kPackWidth; first += L::kWidth) {
            const unsigned(*node)[4] = p->node + first;
            Value edges[3][3], b[3][3], f[3][3], stress[3][3];
            gather_edges<L>(position, node, edges);
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    b[i][j] = L::load(p->b[3 * i + j] + first);
            multiply<L>(edges, b, f);
            const Value volume = L::load(p->volume + first);
            Value trace;
            if constexpr (kViscous) {
                Value rate[3][3];
                gather_edges<L>(velocity, node, edges);
                multiply<L>(edges, b, rate);
                trace = Law::template stress<L>(constants, f, rate, volume, stress, energy);
            } else {
                trace = Law::template stress<L>(constants, f, volume, stress, energy);
            }
            least = L::min(least, determinant<L>(f));
            most = L::max(most, trace);

            Value h[3][3];
            multiply_transposed<L>(stress, b, h);
            typename L::Points corner[4];
            for (int j = 0; j < 3; ++j) {
                const Value column[3] = {h[0][j], h[1][j], h[2][j]};
                corner[j + 1] = L::to_points(column);
            }
            corner[0] = L::sum(L::sum(corner[1], corner[2]), corner[3]);
            unroll<L::kWidth>([&]<int i>() {
                L::template add<i>(force + node[i][0], corner[0]);
                L::template subtract<i>(force + node[i][1], corner[1]);
                L::template subtract<i>(force + node[i][2], corner[2]);
                L::template subtract<i>(force + node[i][3], corner[3]);
            });
        }
    }
    widen<L>(range, least, most, energy);
}

} // namespace ode::soft::ODE_SOFT_ISA
