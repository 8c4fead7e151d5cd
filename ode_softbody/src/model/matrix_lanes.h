#pragma once

#include "base/lane.h"

namespace ode::soft::ODE_SOFT_ISA {

/// c = a b, all 3x3.
template <class L>
[[gnu::always_inline]] inline void multiply(const typename L::Value (&a)[3][3],
                                            const typename L::Value (&b)[3][3],
                                            typename L::Value (&c)[3][3]) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            c[i][j] = L::fma(a[i][2], b[2][j], L::fma(a[i][1], b[1][j], a[i][0] * b[0][j]));
}

/// c = a b^T.
template <class L>
[[gnu::always_inline]] inline void multiply_transposed(const typename L::Value (&a)[3][3],
                                                       const typename L::Value (&b)[3][3],
                                                       typename L::Value (&c)[3][3]) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            c[i][j] = L::fma(a[i][2], b[j][2], L::fma(a[i][1], b[j][1], a[i][0] * b[j][0]));
}

template <class L>
[[gnu::always_inline]] inline typename L::Value determinant(const typename L::Value (&f)[3][3]) {
    const auto c0 = L::fma(-f[1][2], f[2][1], f[1][1] * f[2][2]);
    const auto c1 = L::fma(-f[1][0], f[2][2], f[1][2] * f[2][0]);
    const auto c2 = L::fma(-f[1][1], f[2][0], f[1][0] * f[2][1]);
    return L::fma(f[0][2], c2, L::fma(f[0][1], c1, f[0][0] * c0));
}

/// The cofactor matrix: derivative of det f.
template <class L>
[[gnu::always_inline]] inline void cofactor(const typename L::Value (&f)[3][3],
                                            typename L::Value (&c)[3][3]) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            c[i][j] = L::fma(-f[i1][j2], f[i2][j1], f[i1][j1] * f[i2][j2]);
        }
}

/// A symmetric 3x3 matrix: 00 11 22 01 12 20.
template <class L>
struct Symmetric {
    typename L::Value at[6];
};

inline constexpr int kPair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

/// out = f s.
template <class L>
[[gnu::always_inline]] inline void times_symmetric(const typename L::Value (&f)[3][3],
                                                   const Symmetric<L>& s,
                                                   typename L::Value (&out)[3][3]) {
    for (int i = 0; i < 3; ++i) {
        out[i][0] = L::fma(f[i][2], s.at[5], L::fma(f[i][1], s.at[3], f[i][0] * s.at[0]));
        out[i][1] = L::fma(f[i][2], s.at[4], L::fma(f[i][1], s.at[1], f[i][0] * s.at[3]));
        out[i][2] = L::fma(f[i][2], s.at[2], L::fma(f[i][1], s.at[4], f[i][0] * s.at[5]));
    }
}

/// f^T f - I, twice Green's strain. The unit is subtracted inside the sum of products, so that a
/// body at rest carries no stress but that of the rounding of f.
template <class L>
[[gnu::always_inline]] inline void twice_green_strain(const typename L::Value (&f)[3][3],
                                                      Symmetric<L>& e) {
    using Value = typename L::Value;
    for (int k = 0; k < 6; ++k) {
        const int i = kPair[k][0], j = kPair[k][1];
        const Value last = k < 3 ? L::fma(f[2][i], f[2][j], Value{} - 1.0) : f[2][i] * f[2][j];
        e.at[k] = L::fma(f[0][i], f[0][j], L::fma(f[1][i], f[1][j], last));
    }
}

} // namespace ode::soft::ODE_SOFT_ISA
