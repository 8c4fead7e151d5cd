#pragma once

#include "model/rotation_lanes.h"
#include "model/viscous_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

/// Co-rotated linear elasticity: P = 2 mu (F - R) + lambda tr(R^T F - I) R, R the nearest rotation.
struct ElasticCorotated {
    using Constants = CorotatedConstants;

    /// @param energy  grows by mu |F - R|^2 + lambda/2 tr(R^T F - I)^2 [J].
    /// @return tr(F^T F); `out` becomes volume * P.
    template <class L>
    [[gnu::always_inline]] static inline typename L::Value
    stress(const Constants& c, const typename L::Value (&f)[3][3], typename L::Value volume,
           typename L::Value (&out)[3][3], typename L::Value& energy) {
        using Value = typename L::Value;
        Value square = f[0][0] * f[0][0];
        for (int i = 1; i < 9; ++i)
            square = L::fma(f[i / 3][i % 3], f[i / 3][i % 3], square);
        Value r[3][3];
        nearest_rotation<L>(f, square, r);
        Value strain = Value{} - 3.0;
        for (int i = 0; i < 9; ++i)
            strain = L::fma(r[i / 3][i % 3], f[i / 3][i % 3], strain);
        const Value pressure = volume * c.lambda * strain, shear = volume * c.two_mu;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                out[i][j] = L::fma(pressure, r[i][j], shear * (f[i][j] - r[i][j]));
        Value apart = (f[0][0] - r[0][0]) * (f[0][0] - r[0][0]);
        for (int i = 1; i < 9; ++i) {
            const Value d = f[i / 3][i % 3] - r[i / 3][i % 3];
            apart = L::fma(d, d, apart);
        }
        energy = energy + 0.5 * L::fma(pressure, strain, shear * apart);
        return square;
    }
};
using Corotated = WithViscosity<ElasticCorotated>;

} // namespace ode::soft::ODE_SOFT_ISA
