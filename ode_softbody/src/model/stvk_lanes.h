#pragma once

#include "model/viscous_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

/// St. Venant-Kirchhoff: S = lambda tr(E) I + 2 mu E + phi tr(Edot) I + 2 psi Edot, P = F S
/// (P01 3.1).
struct Stvk {
    using Constants = StvkConstants;

    /// @param energy  grows by the elastic one [J].
    /// @return tr(F^T F); `out` becomes volume * P.
    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    stress(const Constants& c, const typename L::Value (&f)[3][3], typename L::Value volume,
           typename L::Value (&out)[3][3], typename L::Value& energy) {
        Symmetric<L> s;
        const auto trace = elastic<L>(c, f, volume, s, energy);
        times_symmetric<L>(f, s, out);
        return trace;
    }

    /// @param rate  dF/dt [1/s].
    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    stress(const Constants& c, const typename L::Value (&f)[3][3],
           const typename L::Value (&rate)[3][3], typename L::Value volume,
           typename L::Value (&out)[3][3], typename L::Value& energy) {
        Symmetric<L> s;
        const auto trace = elastic<L>(c, f, volume, s, energy);
        add_viscous<L>(c.viscosity, f, rate, volume, s);
        times_symmetric<L>(f, s, out);
        return trace;
    }

private:
    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    elastic(const Constants& c, const typename L::Value (&f)[3][3], typename L::Value volume,
            Symmetric<L>& s, typename L::Value& energy) {
        Symmetric<L> e;
        twice_green_strain<L>(f, e);
        const auto trace = e.at[0] + e.at[1] + e.at[2];
        const auto mu = volume * c.mu;
        const auto pressure = volume * c.half_lambda * trace;
        for (int k = 0; k < 3; ++k)
            s.at[k] = L::fma(mu, e.at[k], pressure);
        for (int k = 3; k < 6; ++k)
            s.at[k] = mu * e.at[k];
        // volume * S : E / 2
        const auto axial = L::fma(s.at[2], e.at[2], L::fma(s.at[1], e.at[1], s.at[0] * e.at[0]));
        const auto shear = L::fma(s.at[5], e.at[5], L::fma(s.at[4], e.at[4], s.at[3] * e.at[3]));
        energy = energy + 0.25 * (axial + (shear + shear));
        return trace + 3.0;
    }
};

} // namespace ode::soft::ODE_SOFT_ISA
