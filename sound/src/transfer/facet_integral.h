#pragma once

#include <Eigen/Core>

namespace ode::sound {

using Vec3 = Eigen::Vector3d;

/// A flat triangle and its hat functions, 1 at one corner and 0 at the others.
struct Facet {
    Vec3 corner[3];
    Vec3 normal;   ///< unit, outward
    double area;   ///< [m^2]
    Vec3 slope[3]; ///< gradient of each hat, in the plane [1/m]

    Facet(const Vec3& a, const Vec3& b, const Vec3& c);
    Vec3 centroid() const { return (corner[0] + corner[1] + corner[2]) / 3.0; }
    Vec3 at(const Vec3& bary) const {
        return bary[0] * corner[0] + bary[1] * corner[1] + bary[2] * corner[2];
    }
    /// Longest edge [m].
    double size() const;
};

/// Potentials of a triangle charged with each of its hats, at a point x, in closed form.
struct FacetPotential {
    Vec3 single; ///< integral of hat_j / R [m]
    Vec3 twice;  ///< integral of hat_j d/dn_y (1/R) [-]
};

/// D. R. Wilton et al., "Potential integrals for uniform and linear source distributions on
/// polygonal and polyhedral domains", IEEE Trans. Antennas Propag. 32, 276 (1984). Finite
/// everywhere but for `twice` on the triangle's own edges; on its face `twice` is 0, the mean of
/// both sides.
FacetPotential potential(const Facet& facet, const Vec3& x) noexcept;

} // namespace ode::sound
