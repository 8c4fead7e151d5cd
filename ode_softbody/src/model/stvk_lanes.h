#pragma once

#include "base/lane.h"
#include "model/tet_kernel.h"

namespace ode::soft::ODE_SOFT_ISA {

/// A symmetric 3x3 matrix: 00 11 22 01 12 20.
template <class L>
struct Symmetric {
    typename L::Value at[6];
};

inline constexpr int kPair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

/// St. Venant-Kirchhoff: S = lambda tr(E) I + 2 mu E + phi tr(Edot) I + 2 psi Edot, P = F S
/// (P01 3.1). The unit is subtracted inside the sum of products, so that a body at rest carries no
/// stress but that of the rounding of F.
struct Stvk {
    using Constants = StvkConstants;

    /// @return tr(F^T F); `stress` becomes volume * F S.
    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    stress(const Constants& c, const typename L::Value (&f)[3][3], typename L::Value volume,
           typename L::Value (&out)[3][3]) {
        Symmetric<L> s;
        const auto trace = elastic<L>(c, f, volume, s);
        times_symmetric<L>(f, s, out);
        return trace;
    }

    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    stress(const Constants& c, const typename L::Value (&f)[3][3],
           const typename L::Value (&rate)[3][3], typename L::Value volume,
           typename L::Value (&out)[3][3]) {
        using Value = typename L::Value;
        Symmetric<L> s;
        const auto trace = elastic<L>(c, f, volume, s);
        Value d[6]; // Edot on the diagonal, twice Edot off it
        for (int k = 0; k < 3; ++k)
            d[k] = L::fma(f[2][k], rate[2][k], L::fma(f[1][k], rate[1][k], f[0][k] * rate[0][k]));
        for (int k = 3; k < 6; ++k) {
            const int i = kPair[k][0], j = kPair[k][1];
            d[k] = L::fma(f[2][i], rate[2][j], L::fma(f[1][i], rate[1][j], f[0][i] * rate[0][j]));
            d[k] = L::fma(f[2][j], rate[2][i],
                          L::fma(f[1][j], rate[1][i], L::fma(f[0][j], rate[0][i], d[k])));
        }
        const Value psi = volume * c.psi;
        const Value pressure = volume * c.phi * (d[0] + d[1] + d[2]);
        for (int k = 0; k < 3; ++k)
            s.at[k] = L::fma(psi + psi, d[k], s.at[k] + pressure);
        for (int k = 3; k < 6; ++k)
            s.at[k] = L::fma(psi, d[k], s.at[k]);
        times_symmetric<L>(f, s, out);
        return trace;
    }

private:
    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    elastic(const Constants& c, const typename L::Value (&f)[3][3], typename L::Value volume,
            Symmetric<L>& s) {
        using Value = typename L::Value;
        Value e[6]; // twice Green's strain
        for (int k = 0; k < 6; ++k) {
            const int i = kPair[k][0], j = kPair[k][1];
            const Value last = k < 3 ? L::fma(f[2][i], f[2][j], Value{} - 1.0) : f[2][i] * f[2][j];
            e[k] = L::fma(f[0][i], f[0][j], L::fma(f[1][i], f[1][j], last));
        }
        const Value trace = e[0] + e[1] + e[2];
        const Value mu = volume * c.mu;
        const Value pressure = volume * c.half_lambda * trace;
        for (int k = 0; k < 3; ++k)
            s.at[k] = L::fma(mu, e[k], pressure);
        for (int k = 3; k < 6; ++k)
            s.at[k] = mu * e[k];
        return trace + 3.0;
    }

    template <class L>
    [[gnu::always_inline]] static inline void times_symmetric(const typename L::Value (&f)[3][3],
                                                              const Symmetric<L>& s,
                                                              typename L::Value (&out)[3][3]) {
        for (int i = 0; i < 3; ++i) {
            out[i][0] = L::fma(f[i][2], s.at[5], L::fma(f[i][1], s.at[3], f[i][0] * s.at[0]));
            out[i][1] = L::fma(f[i][2], s.at[4], L::fma(f[i][1], s.at[1], f[i][0] * s.at[3]));
            out[i][2] = L::fma(f[i][2], s.at[2], L::fma(f[i][1], s.at[4], f[i][0] * s.at[5]));
        }
    }
};

} // namespace ode::soft::ODE_SOFT_ISA
