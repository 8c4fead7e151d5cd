#pragma once

#include "base/types.h"
#include "model/solid.h"

namespace ode::soft {

/// Kelvin-Voigt viscosity on the rate of Green's strain (P01 3.1) at one F: minus the derivative of
/// the force of viscous_lanes.h by velocity, per volume.
class ViscousTangent {
public:
    ViscousTangent(const Solid& s, const Mat3& f) noexcept
        : phi_(s.viscous_lambda()), psi_(s.viscous_mu()), f_(f),
          left_cauchy_green_(f * f.transpose()) {}

    /// Of the nodes whose shapes have the gradients a and b:
    /// phi Fa (Fb)^T + psi Fb (Fa)^T + psi (a.b) F F^T.
    Mat3 block(const Vec3& a, const Vec3& b) const noexcept {
        const Vec3 fa = f_ * a, fb = f_ * b;
        return phi_ * fa * fb.transpose() + psi_ * fb * fa.transpose() +
               psi_ * a.dot(b) * left_cauchy_green_;
    }

private:
    double phi_, psi_;
    Mat3 f_, left_cauchy_green_;
};

} // namespace ode::soft
