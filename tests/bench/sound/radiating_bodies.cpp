#include "bench/sound/radiating_bodies.h"

#include "transfer/helmholtz.h"
#include "unit/transfer/shapes.h"
#include "unit/transfer/spherical_cap.h"

#include <cmath>

namespace ode::sound::test {
namespace {

constexpr double kDensity = 1.21, kSpeed = 343.0, kDistance = 3.0;
constexpr double kRadius = 0.1, kLength = 0.3;
using Complex = std::complex<double>;
const Complex kI(0.0, 1.0);

double pulsating(const RadiatingBody& b, double ka) {
    return kDensity * b.size * b.size / (kDistance * std::sqrt(1.0 + ka * ka));
}

double shaking(const RadiatingBody& b, double ka) {
    const double kr = ka / b.size * kDistance;
    return kDensity * std::pow(b.size, 3) / (kDistance * kDistance) *
           std::abs((1.0 + kI * kr) / (2.0 + 2.0 * kI * ka - ka * ka));
}

double piston_axis(const RadiatingBody& b, double ka) {
    const double k = ka / b.size;
    const double path = std::hypot(kDistance, b.size) - kDistance;
    return 2.0 * kDensity * kSpeed * std::abs(std::sin(0.5 * k * path)) / (k * kSpeed);
}

double piston_aside(const RadiatingBody& b, double ka) {
    const double x = ka * 0.5; // sin 30 degrees
    return 0.5 * kDensity * b.size * b.size / kDistance *
           std::abs(2.0 * std::cyl_bessel_j(1, x) / x);
}

/// Shape of bending number n of a free bar between -1 and 1, about.
double bend(int n, double x) {
    return n == 1 ? std::cos(2.365 * x) + 0.1329 * std::cosh(2.365 * x)
                  : std::sin(3.9266 * x) - 0.0279 * std::sinh(3.9266 * x);
}

std::vector<double> bent(const BoundaryMesh& mesh, int n) {
    std::vector<double> shape;
    for (const Vec3& x : mesh.node)
        shape.insert(shape.end(), {0.0, 0.0, bend(n, 2.0 * x[0] / kLength)});
    return shape;
}

const Vec3 kBar(kLength, 0.02, 0.01);

template <int kBend>
double finer_bar(const RadiatingBody& b, double ka) {
    static const HelmholtzProblem problem(block(kBar, {90, 5, 3}));
    const double k = ka / b.size;
    Eigen::VectorXcd slope(3 * static_cast<Eigen::Index>(problem.facets().size()));
    for (std::size_t t = 0; t < problem.facets().size(); ++t)
        for (std::size_t j = 0; j < 3; ++j) {
            const Facet& f = problem.facets()[t];
            slope[static_cast<Eigen::Index>(3 * t + j)] =
                -kDensity * bend(kBend, 2.0 * f.corner[j][0] / kLength) * f.normal[2];
        }
    const Eigen::VectorXcd p = problem.solve(k, slope).col(0);
    return std::abs(problem.at(b.ear, k, slope, p));
}

/// Bending of a half sphere's shell that stretches nothing: Rayleigh, Theory of Sound, 235 (his
/// mode of two waves, along the radius; it grows towards the rim).
double bowl_shape(double theta) {
    return (2.0 + std::cos(theta)) * std::pow(std::tan(0.5 * theta), 2);
}

double bowl_by_series(const RadiatingBody& b, double ka) {
    // Slope per unit acceleration -rho w; lengths in radii.
    const SphericalCap cap(ka, 2, [](double theta) { return -kDensity * bowl_shape(theta); });
    return b.size * std::abs(cap.pressure(b.ear / b.size));
}

RadiatingBody scaled(std::string name, BoundaryMesh mesh,
                     double (*reference)(const RadiatingBody&, double), std::string source,
                     bool compact) {
    RadiatingBody b{std::move(name),       kRadius, std::move(mesh), {},
                    Vec3(0, 0, kDistance), compact, reference,       std::move(source)};
    for (Vec3& x : b.mesh.node)
        x *= kRadius;
    return b;
}

} // namespace

std::vector<RadiatingBody> radiating_bodies() {
    std::vector<RadiatingBody> all;
    all.push_back(scaled("pulsating sphere", sphere(3), pulsating, "Pierce 4-1", true));
    for (const Vec3& x : all.back().mesh.node)
        for (int k = 0; k < 3; ++k)
            all.back().shape.push_back(x[k] / kRadius);
    all.push_back(scaled("shaking sphere", sphere(3), shaking, "Pierce 4-2", true));
    for (std::size_t i = 0; i < all.back().mesh.node.size(); ++i)
        all.back().shape.insert(all.back().shape.end(), {0.0, 0.0, 1.0});
    for (const bool aside : {false, true}) {
        // A baffle is a mirror: both faces of a thin disc move outward.
        RadiatingBody b =
            scaled(aside ? "baffled piston, 30 degrees" : "baffled piston, axis", disc(0.02, 10),
                   aside ? piston_aside : piston_axis, aside ? "Pierce 5-4" : "Pierce 5-7", false);
        for (const Vec3& x : b.mesh.node)
            b.shape.insert(b.shape.end(), {0.0, 0.0, x[2] > 0.0 ? 1.0 : -1.0});
        if (aside)
            b.ear = kDistance * Vec3(0.5, 0.0, std::sqrt(0.75));
        all.push_back(std::move(b));
    }
    all.push_back(scaled("thin bowl, two waves", bowl(0.01, 10), bowl_by_series, "series", false));
    all.back().ear = kDistance * Vec3(0.8, 0.0, 0.6);
    for (const Vec3& x : all.back().mesh.node) {
        const double swing =
            bowl_shape(std::acos(x.normalized().z())) * std::cos(2.0 * std::atan2(x.y(), x.x()));
        for (int k = 0; k < 3; ++k)
            all.back().shape.push_back(swing * x.normalized()[k]);
    }
    for (const int n : {1, 2}) {
        RadiatingBody b;
        b.name = "bar, bending " + std::to_string(n);
        b.size = kLength / 2;
        b.mesh = block(kBar, {30, 2, 1});
        b.shape = bent(b.mesh, n);
        b.ear = kDistance * Vec3(0.36, 0.48, 0.8);
        b.compact = true;
        b.reference = n == 1 ? finer_bar<1> : finer_bar<2>;
        b.source = "1470 elements";
        all.push_back(std::move(b));
    }
    return all;
}

} // namespace ode::sound::test
