#pragma once

#include <Eigen/Core>

namespace ode::sound {

/// What a body makes audible by moving as a whole, in its frame: the click of a small body that is
/// struck ("acceleration noise"). A dipole, filtered as a sphere's of the same strength is:
///
///     p = d/dt [ r . D V / r^2 + r . D V' / (r c) ],   T^2 V'' / 2 + T V' + V = U(t - (r - a)/c)
///
/// with r the unit way to the listener at distance r, U the velocity and the spin, a the sphere's
/// radius and T = a/c: exact for a sphere of any size (A. D. Pierce, Acoustics, 1989, 4-2).
struct RigidSound {
    using Six = Eigen::Matrix<double, 6, 1>; ///< along x, y, z; about x, y, z

    /// D = rho / (4 pi) times the volume moved and the air carried: [kg], [kg m].
    Eigen::Matrix<double, 3, 6> dipole = Eigen::Matrix<double, 3, 6>::Zero();
    double radius = 0;    ///< a [m]
    double speed = 343.0; ///< of sound [m/s]

    /// What differentiates to p [Pa s].  @param way  unit.
    /// @param velocity, slope  V and V'.
    double flow(const Eigen::Vector3d& way, double distance, const Six& velocity,
                const Six& slope) const noexcept {
        return way.dot(dipole * (velocity / distance + slope / speed)) / distance;
    }
};

} // namespace ode::sound
