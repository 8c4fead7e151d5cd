#pragma once

#include "model/law_constants.h"
#include "model/matrix_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

/// Adds volume * (phi tr(Edot) I + 2 psi Edot), Edot = (F^T Fdot + Fdot^T F)/2, to the second
/// Piola-Kirchhoff stress (P01 3.1). Blind to rigid motion; its power is never positive.
template <class L>
[[gnu::always_inline]] inline void
add_viscous(const Viscosity& c, const typename L::Value (&f)[3][3],
            const typename L::Value (&rate)[3][3], typename L::Value volume, Symmetric<L>& s) {
    using Value = typename L::Value;
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
}

/// A law whose elastic part gives the first Piola-Kirchhoff stress directly, with viscosity.
template <class Elastic>
struct WithViscosity : Elastic {
    using Elastic::stress;

    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    stress(const typename Elastic::Constants& c, const typename L::Value (&f)[3][3],
           const typename L::Value (&rate)[3][3], typename L::Value volume,
           typename L::Value (&out)[3][3], typename L::Value& energy) {
        Symmetric<L> s{};
        add_viscous<L>(c.viscosity, f, rate, volume, s);
        typename L::Value viscous[3][3];
        times_symmetric<L>(f, s, viscous);
        const auto trace = Elastic::template stress<L>(c, f, volume, out, energy);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                out[i][j] = out[i][j] + viscous[i][j];
        return trace;
    }
};

} // namespace ode::soft::ODE_SOFT_ISA
