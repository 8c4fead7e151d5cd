#pragma once

#include "base/isa.h"
#include "base/types.h"
#include "model/law_constants.h"
#include "model/solid.h"
#include "model/tet_kernel.h"

namespace ode::soft {

/// St. Venant-Kirchhoff (P01 3.1) one point at a time: energy and its second derivative. The force
/// itself is in stvk_lanes.h. Valid while no principal stretch falls below 1/sqrt(3), where the
/// law softens in compression.

/// Constants of the tangent at one F, shared by all pairs of shapes.
class StvkTangent {
public:
    StvkTangent(const Solid& s, const Mat3& f) noexcept
        : lambda_(s.lambda()), mu_(s.mu()), f_(f), left_cauchy_green_(f * f.transpose()) {
        const Mat3 e = 0.5 * (f.transpose() * f - Mat3::Identity());
        stress_ = lambda_ * e.trace() * Mat3::Identity() + 2 * mu_ * e;
    }

    /// Second derivative of the energy per volume by the positions of two nodes whose shapes have
    /// the gradients a and b: (a.S b) I + lambda Fa (Fb)^T + mu Fb (Fa)^T + mu (a.b) F F^T.
    Mat3 block(const Vec3& a, const Vec3& b) const noexcept {
        const Vec3 fa = f_ * a, fb = f_ * b;
        return a.dot(stress_ * b) * Mat3::Identity() + lambda_ * fa * fb.transpose() +
               mu_ * fb * fa.transpose() + mu_ * a.dot(b) * left_cauchy_green_;
    }

private:
    double lambda_, mu_;
    Mat3 f_, left_cauchy_green_, stress_;
};

struct StvkLaw {
    using Constants = StvkConstants;
    using Tangent = StvkTangent;

    static Constants constants(const Solid& s) noexcept {
        return {s.lambda() / 2, s.mu(), {s.viscous_lambda(), s.viscous_mu()}};
    }
    /// Elastic energy per rest volume [J/m^3]: lambda/2 tr(E)^2 + mu E:E.
    static double energy(const Solid& s, const Mat3& f) noexcept {
        const Mat3 e = 0.5 * (f.transpose() * f - Mat3::Identity());
        return 0.5 * s.lambda() * e.trace() * e.trace() + s.mu() * e.squaredNorm();
    }
    static TetForce<Constants> kernel(Isa isa, TetShape shape, bool viscous) noexcept;
};

} // namespace ode::soft
