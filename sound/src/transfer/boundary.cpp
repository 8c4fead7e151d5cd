#include "transfer/boundary.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

struct Rule {
    std::vector<Vec3> bary;
    std::vector<double> weight; ///< sum 1
};

/// Seven points, exact for degree 5: R. Radon (1948).
const Rule& seven_points() {
    static const Rule kRule = [] {
        Rule r;
        r.bary.emplace_back(1.0 / 3, 1.0 / 3, 1.0 / 3);
        r.weight.push_back(9.0 / 40);
        for (const double sign : {1.0, -1.0}) {
            const double b = (6.0 + sign * std::sqrt(15.0)) / 21.0;
            const double w = (155.0 + sign * std::sqrt(15.0)) / 1200.0;
            for (int k = 0; k < 3; ++k) {
                Vec3 at(b, b, b);
                at[k] = 1.0 - 2.0 * b;
                r.bary.push_back(at);
                r.weight.push_back(w);
            }
        }
        return r;
    }();
    return kRule;
}

/// seven_points() on each of the four quarters of a triangle: for pairs that touch.
const Rule& fine_points() {
    static const Rule kRule = [] {
        const Vec3 c[3] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
        const Vec3 m[3] = {(c[1] + c[2]) / 2, (c[2] + c[0]) / 2, (c[0] + c[1]) / 2};
        const Vec3 part[4][3] = {
            {c[0], m[2], m[1]}, {c[1], m[0], m[2]}, {c[2], m[1], m[0]}, {m[0], m[1], m[2]}};
        Rule r;
        for (const auto& p : part)
            for (std::size_t q = 0; q < seven_points().bary.size(); ++q) {
                const Vec3& b = seven_points().bary[q];
                r.bary.push_back(b[0] * p[0] + b[1] * p[1] + b[2] * p[2]);
                r.weight.push_back(seven_points().weight[q] / 4);
            }
        return r;
    }();
    return kRule;
}

NearPair correction(const Facet& at, const Facet& of, int other, const Rule& rule) {
    NearPair pair{other, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
    for (std::size_t q = 0; q < rule.bary.size(); ++q) {
        const FacetPotential v = potential(of, at.at(rule.bary[q]));
        const Vec3 w = at.area * rule.weight[q] * rule.bary[q];
        pair.single += w * v.single.transpose();
        pair.twice += w * v.twice.transpose();
    }
    for (const Vec3& a : three_points())
        for (const Vec3& b : three_points()) {
            const Vec3 way = at.at(a) - of.at(b);
            const double r = way.norm();
            if (r == 0.0)
                continue;
            const double w = at.area * of.area / 9.0 / r;
            pair.single -= w * a * b.transpose();
            pair.twice -= w * way.dot(of.normal) / (r * r) * a * b.transpose();
        }
    return pair;
}

} // namespace

std::vector<Facet> BoundaryMesh::facets() const {
    std::vector<Facet> out;
    out.reserve(triangle.size());
    for (const auto& t : triangle)
        out.emplace_back(node[static_cast<std::size_t>(t[0])], node[static_cast<std::size_t>(t[1])],
                         node[static_cast<std::size_t>(t[2])]);
    return out;
}

Vec3 BoundaryMesh::centre() const {
    Vec3 sum = Vec3::Zero();
    double area = 0.0;
    for (const Facet& f : facets()) {
        sum += f.area * f.centroid();
        area += f.area;
    }
    return area > 0.0 ? Vec3(sum / area) : Vec3::Zero();
}

double BoundaryMesh::radius(const Vec3& centre) const {
    double most = 0.0;
    for (const auto& t : triangle)
        for (const int i : t)
            most = std::max(most, (node[static_cast<std::size_t>(i)] - centre).norm());
    return most;
}

double BoundaryMesh::longest_edge() const {
    double most = 0.0;
    for (const Facet& f : facets())
        most = std::max(most, f.size());
    return most;
}

std::vector<std::vector<NearPair>> near_pairs(std::span<const Facet> facet) {
    // Three points against three err by some (size / distance)^4 / 100 of the pair's share.
    constexpr double kNear = 2.5;  // times the larger size
    constexpr double kTouch = 1.2; // the integrand is singular or nearly so along an edge
    std::vector<std::vector<NearPair>> out(facet.size());
    for (std::size_t i = 0; i < facet.size(); ++i)
        for (std::size_t j = 0; j < facet.size(); ++j) {
            const double size = std::max(facet[i].size(), facet[j].size());
            const double distance = (facet[i].centroid() - facet[j].centroid()).norm();
            if (distance < kNear * size)
                out[i].push_back(
                    correction(facet[i], facet[j], static_cast<int>(j),
                               distance < kTouch * size ? fine_points() : seven_points()));
        }
    return out;
}

} // namespace ode::sound
