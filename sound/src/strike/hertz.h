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

/// dF/d(depth) = (6 E*^2 F / curvature)^(1/3) of a contact that bears a load F (same place, 4.2)
/// [N/m].
double bearing_stiffness(double load, double curvature, double modulus) noexcept;
/// Of such a contact: (3 F / (4 E* curvature))^(1/3) [m].
double bearing_radius(double load, double curvature, double modulus) noexcept;

inline constexpr double kShortest = 10e-6; ///< [s]: nothing above 22 kHz is missed by longer ones
inline constexpr double kLongest = 50e-3;  ///< [s]

} // namespace ode::sound
