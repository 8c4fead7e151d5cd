#pragma once

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <vector>

namespace ode::sound::test {

/// Sound of a half sphere of no thickness in free air that vibrates along its radius: an exact
/// solution by series, against which boundary elements of thin shells are judged. Radius 1, pole on
/// +z, time factor e^{i w t}.
///
/// Inside p = sum A_n j_n(kr) P_n^m(cos theta) cos(m phi), outside with h_n. The slope U of p along
/// r is the same on both sides of the whole sphere, the jump J of p is nought beyond the cap:
/// U_n = J_n / Z_n, Z_n = (h_n / h_n' - j_n / j_n') / k. J = sqrt(cos theta) sin^m theta times a
/// polynomial, which has the edge's singularity, is found by Galerkin's method on the cap from
/// sum J_n / Z_n P_n^m = U there. (Dual series as for discs and domes: T. Mellow, L. Karkkainen, J.
/// Acoust. Soc. Am. 120, 2460 (2006).)
class SphericalCap {
public:
    using Complex = std::complex<double>;

    /// @param k      wave number, times the radius
    /// @param m      waves round the axis: all goes as cos(m phi)
    /// @param slope  dp/dr at angle theta from the pole
    SphericalCap(double k, int m, const std::function<double(double theta)>& slope);

    Complex pressure(const Eigen::Vector3d& x) const; ///< outside the sphere

private:
    double k_;
    int m_;
    std::vector<Complex> outside_; ///< factor of h_n(kr) P_n^m, normalised, n from m
};

} // namespace ode::sound::test
