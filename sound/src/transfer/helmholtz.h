#pragma once

#include "transfer/boundary.h"

#include <complex>

namespace ode::sound {

/// Sound outside a closed surface that vibrates at one frequency, time factor e^{i w t}.
///
/// Burton & Miller's combination of the Kirchhoff-Helmholtz integral and its normal derivative
/// (A. J. Burton, G. F. Miller, Proc. R. Soc. A 323, 201 (1971)), which has no spurious resonances:
///
///     (1/2 - K - a N) p = -(S + a (1/2 + K')) q,   q = dp/dn = -rho (normal acceleration),
///
/// a = -i/k, G = e^{-ikR}/(4 pi R). Galerkin's method with a pressure that is linear on every
/// triangle: the hypersingular N is then -curl G curl + k^2 n.n' G, weakly singular, and thin
/// bodies keep the jump of pressure from one face to the other, which collocation loses.
class HelmholtzProblem {
public:
    using Complex = std::complex<double>;
    using Matrix = Eigen::MatrixXcd;

    explicit HelmholtzProblem(BoundaryMesh mesh);

    const BoundaryMesh& mesh() const noexcept { return mesh_; }
    std::span<const Facet> facets() const noexcept { return facet_; }

    /// @param wave_number  k = w/c [1/m]; 0 is incompressible flow.
    /// @param slope        q at the corners of every triangle, three rows a triangle, a column each
    ///                     case.
    /// @return pressure at the nodes, a column each case; in the unit of q times m.
    Matrix solve(double wave_number, const Matrix& slope) const;

    /// Pressure in the air, of one case. Not nearer to the surface than a triangle's size.
    Complex at(const Vec3& x, double wave_number, const Eigen::VectorXcd& slope,
               const Eigen::VectorXcd& pressure) const;

private:
    struct Points; ///< quadrature points by coordinate

    BoundaryMesh mesh_;
    std::vector<Facet> facet_;
    std::vector<std::vector<NearPair>> near_;
    double reach_; ///< radius of the body [m]
};

} // namespace ode::sound
