#pragma once

#include "model/matrix_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

/// Laguerre's steps from the bound sqrt(3 tr) to the largest root. At rest the bound is the root;
/// for stretches of 1/10 and 10 together five steps leave rounding alone. (Newton takes twelve: the
/// two largest roots of a thin element lie close.) A fixed number keeps bits equal over lane
/// widths.
inline constexpr int kRootSteps = 5;

/// Determinant of a symmetric 4x4 matrix given by rows; with kAdjugate also its adjugate.
template <class L, bool kAdjugate>
[[gnu::always_inline]] inline typename L::Value determinant4(const typename L::Value (&a)[4][4],
                                                             typename L::Value (&b)[4][4]) {
    using Value = typename L::Value;
    const auto minor = [&](int r, int i, int j) { // of rows r, r + 1 and columns i, j
        return L::fma(-a[r][j], a[r + 1][i], a[r][i] * a[r + 1][j]);
    };
    const Value s0 = minor(0, 0, 1), s1 = minor(0, 0, 2), s2 = minor(0, 0, 3);
    const Value s3 = minor(0, 1, 2), s4 = minor(0, 1, 3), s5 = minor(0, 2, 3);
    const Value c0 = minor(2, 0, 1), c1 = minor(2, 0, 2), c2 = minor(2, 0, 3);
    const Value c3 = minor(2, 1, 2), c4 = minor(2, 1, 3), c5 = minor(2, 2, 3);
    if constexpr (kAdjugate) {
        b[0][0] = a[1][1] * c5 - a[1][2] * c4 + a[1][3] * c3;
        b[0][1] = a[0][2] * c4 - a[0][1] * c5 - a[0][3] * c3;
        b[0][2] = a[3][1] * s5 - a[3][2] * s4 + a[3][3] * s3;
        b[0][3] = a[2][2] * s4 - a[2][1] * s5 - a[2][3] * s3;
        b[1][1] = a[0][0] * c5 - a[0][2] * c2 + a[0][3] * c1;
        b[1][2] = a[3][2] * s2 - a[3][0] * s5 - a[3][3] * s1;
        b[1][3] = a[2][0] * s5 - a[2][2] * s2 + a[2][3] * s1;
        b[2][2] = a[3][0] * s4 - a[3][1] * s2 + a[3][3] * s0;
        b[2][3] = a[2][1] * s2 - a[2][0] * s4 - a[2][3] * s0;
        b[3][3] = a[2][0] * s3 - a[2][1] * s1 + a[2][2] * s0;
        for (int i = 1; i < 4; ++i)
            for (int j = 0; j < i; ++j)
                b[i][j] = b[j][i];
    }
    return (s0 * c5 - s1 * c4 + s2 * c3) + (s3 * c2 - s4 * c1 + s5 * c0);
}

/// The rotation nearest to f, of all rotations and with no memory: a half turn is as good as none,
/// and an inverted f gives a rotation still. It maximises q^T K q over unit quaternions q
/// (Davenport; Horn 1987, doi:10.1364/JOSAA.4.000629): the largest eigenvalue by Newton on the
/// quartic, its vector as the largest column of the adjugate. Undefined in direction only where the
/// two smallest signed stretches cancel, which takes an inverted element.
template <class L>
[[gnu::always_inline]] inline void nearest_rotation(const typename L::Value (&f)[3][3],
                                                    typename L::Value square,
                                                    typename L::Value (&r)[3][3]) {
    using Value = typename L::Value;
    Value k[4][4];
    k[0][0] = f[0][0] + f[1][1] + f[2][2];
    k[1][1] = f[0][0] - f[1][1] - f[2][2];
    k[2][2] = f[1][1] - f[0][0] - f[2][2];
    k[3][3] = f[2][2] - f[0][0] - f[1][1];
    k[0][1] = k[1][0] = f[2][1] - f[1][2];
    k[0][2] = k[2][0] = f[0][2] - f[2][0];
    k[0][3] = k[3][0] = f[1][0] - f[0][1];
    k[1][2] = k[2][1] = f[0][1] + f[1][0];
    k[1][3] = k[3][1] = f[0][2] + f[2][0];
    k[2][3] = k[3][2] = f[1][2] + f[2][1];

    // p = x^4 + c2 x^2 + c1 x + c0 has real roots only, so Laguerre's method descends to the
    // largest from any bound above it. Sum of stretches <= sqrt(3 tr(F^T F)).
    Value b[4][4];
    const Value zero{};
    const Value c2 = -2.0 * square, c1 = -8.0 * determinant<L>(f);
    const Value c0 = determinant4<L, false>(k, b);
    Value x = L::sqrt(3.0 * square);
    for (int step = 0; step < kRootSteps; ++step) {
        const Value xx = x * x;
        const Value p = L::fma(L::fma(xx + c2, x, c1), x, c0);
        const Value slope = L::fma(4.0 * xx + 2.0 * c2, x, c1);
        const Value bend = 12.0 * xx + 2.0 * c2;
        const Value radicand = L::fma(9.0 * slope, slope, -12.0 * p * bend);
        x = x - 4.0 * p / (slope + L::sqrt(L::max(radicand, zero)) + 1e-300);
    }

    for (int i = 0; i < 4; ++i)
        k[i][i] = k[i][i] - x;
    determinant4<L, true>(k, b);
    Value q[4] = {b[0][0], b[0][1], b[0][2], b[0][3]}, largest = b[0][0] * b[0][0];
    for (int i = 1; i < 4; ++i) {
        const Value size = b[i][i] * b[i][i];
        for (int j = 0; j < 4; ++j)
            q[j] = size > largest ? b[i][j] : q[j];
        largest = L::max(largest, size);
    }
    const Value norm =
        L::fma(q[0], q[0], L::fma(q[1], q[1], L::fma(q[2], q[2], q[3] * q[3]))) + 1e-300;
    const Value two = 2.0 / norm;
    const Value w = q[0], qx = q[1] * two, qy = q[2] * two, qz = q[3] * two;
    r[0][0] = 1.0 - L::fma(q[2], qy, q[3] * qz);
    r[1][1] = 1.0 - L::fma(q[1], qx, q[3] * qz);
    r[2][2] = 1.0 - L::fma(q[1], qx, q[2] * qy);
    r[0][1] = L::fma(q[1], qy, -(w * qz));
    r[1][0] = L::fma(q[1], qy, w * qz);
    r[0][2] = L::fma(q[1], qz, w * qy);
    r[2][0] = L::fma(q[1], qz, -(w * qy));
    r[1][2] = L::fma(q[2], qz, -(w * qx));
    r[2][1] = L::fma(q[2], qz, w * qx);
}

} // namespace ode::soft::ODE_SOFT_ISA
