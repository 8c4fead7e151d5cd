#pragma once

#include "model/tet4_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

/// dx/dL of the three corner coordinates L1 L2 L3 at the four Gauss points. In a quadratic element
/// it is linear, so it is formed at the corners, where most shapes vanish, and blended: half the
/// arithmetic of summing ten shapes at each point.
template <class L>
[[gnu::always_inline]] inline void gather_gradients(const double* base, const unsigned (*node)[10],
                                                    typename L::Value (&d)[4][3][3]) {
    using Value = typename L::Value;
    unsigned at[10][L::kWidth];
    for (int i = 0; i < L::kWidth; ++i)
        for (int n = 0; n < 10; ++n)
            at[n][i] = node[i][n];
    const auto origin = L::gather(base, at[0]);
    Value x[10][3]; // from corner 0
    for (int n = 1; n < 10; ++n)
        L::to_lanes(L::difference(L::gather(base, at[n]), origin), x[n]);

    const Value three = Value{} + 3.0, four = Value{} + 4.0;
    const Value far = Value{} + kGaussFar, near = Value{} + (kGaussNear - kGaussFar);
    for (int i = 0; i < 3; ++i) {
        for (int j = 1; j < 4; ++j)
            d[0][i][j - 1] = L::fma(four, x[kMidNode[0][j]][i], -x[j][i]);
        for (int c = 1; c < 4; ++c) {
            const Value first = four * x[kMidNode[0][c]][i];
            for (int j = 1; j < 4; ++j)
                d[c][i][j - 1] = j == c ? L::fma(three, x[c][i], -first)
                                        : L::fma(four, x[kMidNode[c][j]][i], -x[j][i]) - first;
        }
        for (int j = 0; j < 3; ++j) {
            const Value sum = far * ((d[0][i][j] + d[1][i][j]) + (d[2][i][j] + d[3][i][j]));
            for (int c = 0; c < 4; ++c)
                d[c][i][j] = L::fma(near, d[c][i][j], sum);
        }
    }
}

template <class L, class Pack, int kEntries>
[[gnu::always_inline]] inline void load_matrix(const double (&from)[kEntries][kPackWidth],
                                               int first, typename L::Value (&b)[3][3]) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            b[i][j] = L::load(from[3 * i + j] + first);
}

/// Quadratic tetrahedra under the law `Law` (see add_tet4_force) with the four-point rule. Stress
/// takes the way back: transformed at the points, blended to the corners, handed to the nodes.
template <class L, class Law, class Pack, bool kViscous>
void add_tet10_force(const void* packs, std::size_t count, const typename Law::Constants& constants,
                     const double* position, [[maybe_unused]] const double* velocity, double* force,
                     DeformationRange& range) {
    using Value = typename L::Value;
    constexpr bool kCurved = sizeof(Pack) == sizeof(CurvedTet10Pack);
    const Pack* pack = static_cast<const Pack*>(packs);
    Value least = range.min_determinant + Value{};
    Value most = range.max_trace + Value{};
    Value energy{};
    const Value four = Value{} + 4.0;
    const Value far = Value{} + kGaussFar, near = Value{} + (kGaussNear - kGaussFar);
    for (const Pack* p = pack; p != pack + count; ++p) {
        prefetch(p + 1);
        for (int first = 0; first < kPackWidth; first += L::kWidth) {
            const unsigned(*node)[10] = p->node + first;
            Value d[4][3][3], rate[4][3][3], h[4][3][3], b[3][3], volume;
            gather_gradients<L>(position, node, d);
            if constexpr (kViscous)
                gather_gradients<L>(velocity, node, rate);
            if constexpr (!kCurved) {
                load_matrix<L, Pack>(p->b, first, b);
                volume = 0.25 * L::load(p->volume + first);
            }
            for (int q = 0; q < 4; ++q) {
                if constexpr (kCurved) {
                    load_matrix<L, Pack>(p->b[q], first, b);
                    volume = L::load(p->volume[q] + first);
                }
                Value f[3][3], stress[3][3], trace;
                multiply<L>(d[q], b, f);
                if constexpr (kViscous) {
                    Value f_rate[3][3];
                    multiply<L>(rate[q], b, f_rate);
                    trace = Law::template stress<L>(constants, f, f_rate, volume, stress, energy);
                } else {
                    trace = Law::template stress<L>(constants, f, volume, stress, energy);
                }
                least = L::min(least, determinant<L>(f));
                most = L::max(most, trace);
                multiply_transposed<L>(stress, b, h[q]);
            }

            // h becomes the derivative of energy by dx/dL at the corners; minus its rows summed,
            // that by L0.
            Value g[10][3]; // minus the force
            for (int i = 0; i < 3; ++i) {
                Value total[3], zeroth[4];
                for (int j = 0; j < 3; ++j) {
                    const Value sum = (h[0][i][j] + h[1][i][j]) + (h[2][i][j] + h[3][i][j]);
                    total[j] = sum; // the blend keeps the sum over corners
                    for (int c = 0; c < 4; ++c)
                        h[c][i][j] = L::fma(near, h[c][i][j], far * sum);
                }
                for (int c = 1; c < 4; ++c)
                    zeroth[c] = (h[c][i][0] + h[c][i][1]) + h[c][i][2];
                for (int j = 1; j < 4; ++j) {
                    g[j][i] = L::fma(four, h[j][i][j - 1], -total[j - 1]);
                    g[kMidNode[0][j]][i] = four * (h[0][i][j - 1] - zeroth[j]);
                    for (int k = j + 1; k < 4; ++k)
                        g[kMidNode[j][k]][i] = four * (h[j][i][k - 1] + h[k][i][j - 1]);
                }
            }
            typename L::Points at[10];
            for (int n = 1; n < 10; ++n)
                at[n] = L::to_points(g[n]);
            at[0] = at[1];
            for (int n = 2; n < 10; ++n)
                at[0] = L::sum(at[0], at[n]);
            unroll<L::kWidth>([&]<int i>() {
                L::template add<i>(force + node[i][0], at[0]);
                for (int n = 1; n < 10; ++n)
                    L::template subtract<i>(force + node[i][n], at[n]);
            });
        }
    }
    widen<L>(range, least, most, energy);
}

template <class L, class Law>
TetForce<typename Law::Constants> choose_kernel(TetShape shape, bool viscous) {
    switch (shape) {
    case TetShape::linear:
        return viscous ? add_tet4_force<L, Law, true> : add_tet4_force<L, Law, false>;
    case TetShape::quadratic:
        return viscous ? add_tet10_force<L, Law, Tet10Pack, true>
                       : add_tet10_force<L, Law, Tet10Pack, false>;
    default:
        return viscous ? add_tet10_force<L, Law, CurvedTet10Pack, true>
                       : add_tet10_force<L, Law, CurvedTet10Pack, false>;
    }
}

} // namespace ode::soft::ODE_SOFT_ISA
