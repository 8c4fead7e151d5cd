#pragma once

#include "model/viscous_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

/// Smith, de Goes & Kim 2018 (doi:10.1145/3180491), eq. 18:
/// P = mu (1 - 1/(I_C + 1)) F + lambda (J - alpha) dJ/dF, alpha = 1 + 3 mu / (4 lambda).
struct ElasticStableNeoHookean {
    using Constants = NeoHookeanConstants;

    /// @param energy  grows by mu/2 (e - log(1 + e/4)) - 3/4 mu (J - 1) + lambda/2 (J - 1)^2, e =
    ///                I_C - 3: ibid. eq. 14, less its value at rest. The logarithm by three terms
    ///                of 2 artanh(e / (8 + e)): exact at small strain, and to 1 % of the energy at
    ///                any.
    /// @return I_C = tr(F^T F); `out` becomes volume * P.
    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    stress(const Constants& c, const typename L::Value (&f)[3][3], typename L::Value volume,
           typename L::Value (&out)[3][3], typename L::Value& energy) {
        using Value = typename L::Value;
        // As a departure from the 3 and the 1 of rest, so that rest is exactly free of stress:
        // 1 - 1/(I_C + 1) - 3/4 = e / (4 (4 + e)), e = I_C - 3.
        Symmetric<L> green;
        twice_green_strain<L>(f, green);
        const Value e = green.at[0] + green.at[1] + green.at[2];
        const Value shear = volume * c.mu * 0.25 * (e / (e + 4.0));
        const Value rest = volume * c.mu * 0.75;
        Value cof[3][3];
        cofactor<L>(f, cof);
        const Value grown =
            L::fma(f[0][2], cof[0][2],
                   L::fma(f[0][1], cof[0][1], L::fma(f[0][0], cof[0][0], Value{} - 1.0))); // J - 1
        const Value pressure = volume * c.lambda * grown;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                out[i][j] = L::fma(shear, f[i][j],
                                   L::fma(pressure, cof[i][j], rest * (f[i][j] - cof[i][j])));
        const Value z = e / (e + 8.0), z2 = z * z;
        const Value logarithm =
            (z + z) * L::fma(z2, L::fma(z2, Value{} + 0.2, Value{} + 1.0 / 3), Value{} + 1.0);
        energy =
            energy + 0.5 * L::fma(pressure, grown,
                                  volume * c.mu * (L::fma(grown, Value{} - 1.5, e) - logarithm));
        return e + 3.0;
    }
};
using StableNeoHookean = WithViscosity<ElasticStableNeoHookean>;

} // namespace ode::soft::ODE_SOFT_ISA
