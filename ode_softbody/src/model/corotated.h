#pragma once

#include "base/isa.h"
#include "base/types.h"
#include "model/law_constants.h"
#include "model/solid.h"
#include "model/tet10_packs.h"
#include "model/tet4_packs.h"
#include "model/tet_model.h"

namespace ode::soft {

/// Co-rotated linear elasticity: mu |F - R|^2 + lambda/2 tr(R^T F - I)^2 per volume, R the rotation
/// nearest to F (Mueller & Gross 2004, with the exact gradient: P follows from the energy). Large
/// turns, small strains; resists neither collapse nor inversion for good.
class CorotatedTangent {
public:
    CorotatedTangent(const Solid& s, const Mat3& f) noexcept;

    /// Second derivative of the energy per volume by the positions of two nodes whose shapes have
    /// the gradients a and b.
    Mat3 block(const Vec3& a, const Vec3& b) const noexcept;

private:
    Mat3 rotation_;
    Mat3 spin_; ///< (tr(S) I - S)^-1, S = R^T F: turns of R by torques on F
    double lambda_, mu_, turning_;
};

struct CorotatedLaw {
    using Constants = CorotatedConstants;
    using Tangent = CorotatedTangent;

    static Constants constants(const Solid& s) noexcept {
        return {s.lambda(), 2 * s.mu(), {s.viscous_lambda(), s.viscous_mu()}};
    }
    static double energy(const Solid& s, const Mat3& f) noexcept; ///< per rest volume [J/m^3]
    static TetForce<Constants> kernel(Isa isa, TetShape shape, bool viscous) noexcept;
};

using CorotatedLinear = TetModel<CorotatedLaw, Tet4Packs>;
using CorotatedQuadratic = TetModel<CorotatedLaw, Tet10Packs>;
extern template class TetModel<CorotatedLaw, Tet4Packs>;
extern template class TetModel<CorotatedLaw, Tet10Packs>;

} // namespace ode::soft
