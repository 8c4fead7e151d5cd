#include "transfer/facet_integral.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace ode::sound {

Facet::Facet(const Vec3& a, const Vec3& b, const Vec3& c) : corner{a, b, c} {
    const Vec3 twice = (b - a).cross(c - a);
    const double length = twice.norm();
    area = 0.5 * length;
    normal = length > 0.0 ? Vec3(twice / length) : Vec3::Zero();
    for (int j = 0; j < 3; ++j) {
        const Vec3 across = corner[(j + 2) % 3] - corner[(j + 1) % 3];
        slope[j] = length > 0.0 ? Vec3(normal.cross(across) / length) : Vec3::Zero();
    }
}

double Facet::size() const {
    return std::max({(corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(),
                     (corner[0] - corner[2]).norm()});
}

FacetPotential potential(const Facet& facet, const Vec3& x) noexcept {
    const double height = (x - facet.corner[0]).dot(facet.normal);
    const Vec3 foot = x - height * facet.normal;
    const double least = 1e-12 * std::sqrt(facet.area); // below, the point lies in the plane
    const double d = std::abs(height) > least ? std::abs(height) : 0.0;

    double one = 0.0;            // integral of 1 / R
    double angle = 0.0;          // |solid angle|
    Vec3 moment = Vec3::Zero();  // integral of (y - foot) / R
    Vec3 outflow = Vec3::Zero(); // boundary integral of the edges' normals / R
    for (int e = 0; e < 3; ++e) {
        const Vec3& from = facet.corner[e];
        const Vec3& to = facet.corner[(e + 1) % 3];
        const Vec3 along = (to - from).normalized();
        const Vec3 out = along.cross(facet.normal); // away from the triangle, in its plane
        const double p = (from - foot).dot(out);
        const double l0 = (from - foot).dot(along);
        const double l1 = (to - foot).dot(along);
        const double r0 = (from - x).norm();
        const double r1 = (to - x).norm();
        const double square = p * p + d * d;
        // Of the two equal forms the one that doesn't cancel.
        const double log_ratio =
            l0 + l1 >= 0.0 ? std::log((r1 + l1) / (r0 + l0)) : std::log((r0 - l0) / (r1 - l1));
        const double f = std::isfinite(log_ratio) ? log_ratio : 0.0;
        const double beta =
            std::atan2(p * l1, square + d * r1) - std::atan2(p * l0, square + d * r0);
        one += p * f - d * beta;
        angle += beta;
        moment += 0.5 * (square * f + l1 * r1 - l0 * r0) * out;
        outflow += f * out;
    }
    const double sided = d > 0.0 ? std::copysign(angle, height) : 0.0;
    FacetPotential v;
    for (int j = 0; j < 3; ++j) {
        const double hat = 1.0 / 3.0 + facet.slope[j].dot(foot - facet.centroid());
        v.single[j] = hat * one + facet.slope[j].dot(moment);
        v.twice[j] = hat * sided - (d > 0.0 ? height : 0.0) * facet.slope[j].dot(outflow);
    }
    return v;
}

} // namespace ode::sound
