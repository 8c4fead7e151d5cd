#pragma once

namespace ode::sound {

/// What one side of a blow is made of.
struct Elastic {
    double young;   ///< [Pa]
    double poisson; ///< [-]
};

/// E* of two sides: 1/E* = (1 - nu^2)/E + (1 - nu'^2)/E' [Pa].
double contact_modulus(const Elastic& a, const Elastic& b) noexcept;

/// For how long two bodies touch that meet at `speed`, by Hertz's law:
/// 2.87 (m^2 / (R E*^2 v))^(1/5) (K. L. Johnson, Contact Mechanics, 11.4), within kShortest and
/// kLongest.
/// @param mass       effective, of both at the point along the normal [kg].
/// @param curvature  1/R of both together [1/m]: of a ball on a flat the ball's.
/// @param modulus    E* [Pa].  @param speed  closing [m/s].
double contact_time(double mass, double curvature, double modulus, double speed) noexcept;
inline constexpr double kShortest = 10e-6; ///< [s]: nothing above 22 kHz is missed by longer ones
inline constexpr double kLongest = 50e-3;  ///< [s]

} // namespace ode::sound
