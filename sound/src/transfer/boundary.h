#pragma once

#include "transfer/facet_integral.h"

#include <array>
#include <span>
#include <vector>

namespace ode::sound {

/// A closed surface of triangles, corners numbered counter-clockwise from outside.
struct BoundaryMesh {
    std::vector<Vec3> node;
    std::vector<std::array<int, 3>> triangle;

    std::vector<Facet> facets() const;
    Vec3 centre() const;                     ///< of area [m]
    double radius(const Vec3& centre) const; ///< of the nodes' sphere about a point [m]
    double longest_edge() const;             ///< [m]
};

/// The three quadrature points of a triangle, exact for quadratics; equal weights of a third.
inline const std::array<Vec3, 3>& three_points() {
    static const std::array<Vec3, 3> kBary = {Vec3(2.0 / 3, 1.0 / 6, 1.0 / 6),
                                              Vec3(1.0 / 6, 2.0 / 3, 1.0 / 6),
                                              Vec3(1.0 / 6, 1.0 / 6, 2.0 / 3)};
    return kBary;
}

/// What the pairs of near triangles lack when 1/R is integrated by three points on each: exact
/// inner integral, fine outer rule, less that rule. It does not depend on frequency.
struct NearPair {
    int other;
    Eigen::Matrix3d single; ///< integral of hat_i(x) hat_j(y) / R
    Eigen::Matrix3d twice;  ///< with d/dn_y
};

/// Near pairs of every triangle, in order of `other`.
std::vector<std::vector<NearPair>> near_pairs(std::span<const Facet> facet);

} // namespace ode::sound
