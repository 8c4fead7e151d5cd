#pragma once

#include <Eigen/Core>

#include <complex>

namespace ode::sound {

/// Harmonics of all degrees up to `order`: (order + 1)^2, degree l and -l <= m <= l at l^2 + l + m.
constexpr int harmonic_count(int order) noexcept { return (order + 1) * (order + 1); }

constexpr int kMaxOrder = 64; ///< highest degree that is reckoned with

/// Real spherical harmonics, orthonormal on the unit sphere. @param direction  unit.
void harmonics(const Eigen::Vector3d& direction, int order, double* out) noexcept;

/// Spherical Bessel functions j_0 .. j_order of x >= 0.
void spherical_bessel(double x, int order, double* out) noexcept;

/// Outgoing spherical Hankel functions of the second kind (time factor e^{i w t}), x > 0.
void spherical_hankel(double x, int order, std::complex<double>* out) noexcept;

} // namespace ode::sound
