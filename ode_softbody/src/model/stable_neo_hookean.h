#pragma once

#include "base/isa.h"
#include "base/types.h"
#include "model/law_constants.h"
#include "model/solid.h"
#include "model/tet10_packs.h"
#include "model/tet4_packs.h"
#include "model/tet_model.h"

#include <cmath>

namespace ode::soft {

/// Stable neo-Hookean (Smith, de Goes & Kim 2018, doi:10.1145/3180491): finite at any deformation,
/// inverted elements find back. For soft bodies that deform much; rubber near nu = 1/2.
///
/// Its mu and lambda are not Lame's: those that give Hooke's law for small strain are
/// mu = 4/3 mu_Lame, lambda = lambda_Lame + 5/6 mu_Lame (ibid., sec. 3.4). Without them a body is a
/// quarter too soft, 2.6 semitones flat.
class StableNeoHookeanTangent {
public:
    StableNeoHookeanTangent(const Solid& s, const Mat3& f) noexcept;

    /// Second derivative of the energy per volume by the positions of two nodes whose shapes have
    /// the gradients a and b.
    Mat3 block(const Vec3& a, const Vec3& b) const noexcept;

private:
    Mat3 f_, cofactor_;
    double shear_;     ///< mu (1 - 1/(I_C + 1)) [Pa]
    double softening_; ///< 2 mu / (I_C + 1)^2 [Pa]
    double lambda_;    ///< [Pa]
    double pressure_;  ///< lambda (J - alpha) [Pa]
};

struct StableNeoHookeanLaw {
    using Constants = NeoHookeanConstants;
    using Tangent = StableNeoHookeanTangent;

    static Constants constants(const Solid& s) noexcept {
        return {s.lambda() + 5 * s.mu() / 6, 4 * s.mu() / 3, {s.viscous_lambda(), s.viscous_mu()}};
    }
    /// Elastic energy per rest volume, zero at rest [J/m^3]:
    /// mu/2 (I_C - 3) + lambda/2 (J - alpha)^2 - mu/2 log(I_C + 1), ibid. eq. 14.
    static double energy(const Solid& s, const Mat3& f) noexcept;
    static TetForce<Constants> kernel(Isa isa, TetShape shape, bool viscous) noexcept;
};

using StableNeoHookeanLinear = TetModel<StableNeoHookeanLaw, Tet4Packs>;
using StableNeoHookeanQuadratic = TetModel<StableNeoHookeanLaw, Tet10Packs>;
extern template class TetModel<StableNeoHookeanLaw, Tet4Packs>;
extern template class TetModel<StableNeoHookeanLaw, Tet10Packs>;

} // namespace ode::soft
