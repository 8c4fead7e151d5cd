#include "transfer/transfer_table.h"

#include "transfer/coarsen.h"
#include "transfer/helmholtz.h"
#include "transfer/multipole.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ode::sound {
namespace {

constexpr int kMaxOrder = 64;
constexpr double kTau = 2.0 * std::numbers::pi;
using Complex = std::complex<double>;

/// What a listener at twice the radius and beyond can tell: waves of degree l > kr fade as
/// (R/r)^(l+1).
int order_for(double kr) {
    return std::clamp(static_cast<int>(std::ceil(1.05 * kr + 2.0 * std::cbrt(kr))) + 6, 6,
                      kMaxOrder);
}

/// The surface that is solved on, with the shapes at its nodes.
ModalSurface fitted(const ModalSurface& given, const TransferOptions& o) {
    ModalSurface s = given;
    const auto most = static_cast<std::size_t>(o.max_triangles);
    if (s.mesh.triangle.size() > most) {
        const Coarsened coarse = coarsen(s.mesh, most);
        s.mesh = coarse.mesh;
        s.shape.clear();
        for (std::size_t m = 0; m < s.frequency.size(); ++m)
            for (const int i : coarse.kept)
                for (std::size_t k = 0; k < 3; ++k)
                    s.shape.push_back(
                        given.shape[3 * (m * given.mesh.node.size() + static_cast<std::size_t>(i)) +
                                    k]);
    }
    while (4 * s.mesh.triangle.size() <= most &&
           s.mesh.longest_edge() * o.per_wavelength > o.speed / s.frequency.back()) {
        std::vector<std::array<int, 2>> parents;
        const std::size_t before = s.mesh.node.size();
        s.mesh = split(s.mesh, parents);
        std::vector<double> shape;
        for (std::size_t m = 0; m < s.frequency.size(); ++m) {
            const double* old = s.shape.data() + 3 * m * before;
            shape.insert(shape.end(), old, old + 3 * before);
            for (const auto& [a, b] : parents)
                for (int k = 0; k < 3; ++k)
                    shape.push_back(0.5 * (old[3 * a + k] + old[3 * b + k]));
        }
        s.shape = std::move(shape);
    }
    return s;
}

/// -density times normal displacement at the corners of every triangle: dp/dn for unit modal
/// acceleration.
Eigen::VectorXcd slope_of(const ModalSurface& s, std::span<const Facet> facet, std::size_t mode,
                          double density) {
    const double* shape = s.shape.data() + 3 * mode * s.mesh.node.size();
    Eigen::VectorXcd q(3 * static_cast<Eigen::Index>(facet.size()));
    for (std::size_t t = 0; t < facet.size(); ++t)
        for (std::size_t j = 0; j < 3; ++j) {
            const Eigen::Map<const Vec3> u(shape + 3 * s.mesh.triangle[t][j]);
            q[static_cast<Eigen::Index>(3 * t + j)] = -density * u.dot(facet[t].normal);
        }
    return q;
}

/// j_l(kr) Y_lm of a point about the centre.
void regular_waves(const Vec3& x, double k, int order, double* out) {
    double radial[kMaxOrder + 1];
    const double r = x.norm();
    spherical_bessel(k * r, order, radial);
    harmonics(r > 0.0 ? Vec3(x / r) : Vec3::UnitZ(), order, out);
    for (int l = 0; l <= order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            out[i] *= radial[l];
}

/// Coefficients of h_l(kr) Y_lm outside: the addition theorem put into the surface integral,
/// c = -ik integral of p d/dn (j_l Y) - q j_l Y.
/// @param p  pressure at the corners of every triangle, like q.
std::vector<Complex> moments(std::span<const Facet> facet, const Vec3& centre, double radius,
                             double k, int order, const Eigen::VectorXcd& p,
                             const Eigen::VectorXcd& q) {
    const auto n = static_cast<std::size_t>(harmonic_count(order));
    std::vector<Complex> sum(n);
    std::vector<double> at(n), ahead(n), behind(n);
    const double step = 1e-4 * std::min(radius, 1.0 / k); // error of the difference: 1e-8
    for (std::size_t t = 0; t < facet.size(); ++t) {
        const Facet& f = facet[t];
        // A quarter of a wavelength between points at most.
        const int cuts = std::max(1, static_cast<int>(std::ceil(k * f.size() / kTau * 2.0)));
        for (int a = 0; a < cuts; ++a)
            for (int b = 0; b < cuts; ++b)
                for (const Vec3& bary : three_points()) {
                    // Sub-triangles upright (a + b < cuts), and turned over.
                    const bool upright = a + b < cuts;
                    const double u = upright ? a + bary[1] : cuts - a - bary[1];
                    const double v = upright ? b + bary[2] : cuts - b - bary[2];
                    const Vec3 place(1.0 - (u + v) / cuts, u / cuts, v / cuts);
                    const Vec3 x = f.at(place) - centre;
                    const double w = f.area / (3.0 * cuts * cuts);
                    const auto c = static_cast<Eigen::Index>(3 * t);
                    Complex pressure = 0.0, slope = 0.0;
                    for (int j = 0; j < 3; ++j) {
                        pressure += place[j] * p[c + j];
                        slope += place[j] * q[c + j];
                    }
                    regular_waves(x, k, order, at.data());
                    regular_waves(x + step * f.normal, k, order, ahead.data());
                    regular_waves(x - step * f.normal, k, order, behind.data());
                    for (std::size_t i = 0; i < n; ++i)
                        sum[i] += w * (pressure * ((ahead[i] - behind[i]) / (2.0 * step)) -
                                       slope * at[i]);
                }
    }
    std::vector<Complex> outgoing(static_cast<std::size_t>(order) + 1);
    spherical_hankel(k * radius, order, outgoing.data());
    for (int l = 0; l <= order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            sum[static_cast<std::size_t>(i)] *=
                Complex(0.0, -k) * outgoing[static_cast<std::size_t>(l)];
    return sum;
}

void check(const ModalSurface& s) {
    if (s.frequency.empty() || s.shape.size() != 3 * s.frequency.size() * s.mesh.node.size() ||
        s.mesh.triangle.empty())
        throw std::invalid_argument(
            "transfer: " + std::to_string(s.shape.size()) + " numbers of shapes don't fit " +
            std::to_string(s.frequency.size()) + " modes of " + std::to_string(s.mesh.node.size()) +
            " nodes; give x y z of every node for every mode");
    const auto bad = std::find_if(s.frequency.begin(), s.frequency.end(),
                                  [](double f) { return !(f > 0.0) || !std::isfinite(f); });
    if (bad != s.frequency.end() || !std::is_sorted(s.frequency.begin(), s.frequency.end()))
        throw std::invalid_argument("transfer: frequencies must be positive and ascend; leave out "
                                    "motions without strain");
    if (!std::all_of(s.shape.begin(), s.shape.end(), [](double v) { return std::isfinite(v); }))
        throw std::invalid_argument("transfer: a mode shape is not finite; compute the modes anew");
    if (!is_closed(s.mesh))
        throw std::invalid_argument("transfer: the surface is open or its triangles don't agree on "
                                    "which side is out; give the closed surface of a solid");
}

} // namespace

TransferTable make_transfer_table(const ModalSurface& given, const TransferOptions& o) {
    check(given);
    const ModalSurface s = fitted(given, o);
    const HelmholtzProblem problem(s.mesh);
    const std::span<const Facet> facet = problem.facets();
    TransferTable table;
    table.centre = s.mesh.centre();
    table.radius = s.mesh.radius(table.centre);
    table.speed = o.speed;
    table.triangles = static_cast<int>(facet.size());
    table.boundary_limit = o.speed / (o.per_wavelength * s.mesh.longest_edge());
    constexpr double kSameMatrix = 1.01;
    for (std::size_t first = 0; first < s.frequency.size();) {
        std::size_t end = first + 1;
        while (end < s.frequency.size() && s.frequency[end] < kSameMatrix * s.frequency[first])
            ++end;
        const double f = 0.5 * (s.frequency[first] + s.frequency[end - 1]);
        const double k = kTau * f / o.speed;
        Eigen::MatrixXcd slope(3 * static_cast<Eigen::Index>(facet.size()),
                               static_cast<Eigen::Index>(end - first));
        for (std::size_t m = first; m < end; ++m)
            slope.col(static_cast<Eigen::Index>(m - first)) = slope_of(s, facet, m, o.density);
        Eigen::MatrixXcd pressure(slope.rows(), slope.cols());
        if (f <= table.boundary_limit) {
            const Eigen::MatrixXcd nodal = problem.solve(k, slope);
            for (std::size_t t = 0; t < facet.size(); ++t)
                for (std::size_t j = 0; j < 3; ++j)
                    pressure.row(static_cast<Eigen::Index>(3 * t + j)) =
                        nodal.row(s.mesh.triangle[t][j]);
        } else {
            pressure = Complex(0.0, 1.0 / k) * slope; // p = rho c v = -q / (ik)
        }
        const int order = order_for(k * table.radius);
        for (std::size_t m = first; m < end; ++m) {
            const auto c = static_cast<Eigen::Index>(m - first);
            table.mode.push_back({s.frequency[m], order, table.coefficient.size()});
            for (const Complex& a : moments(facet, table.centre, table.radius, k, order,
                                            pressure.col(c), slope.col(c)))
                table.coefficient.emplace_back(a);
        }
        first = end;
    }
    return table;
}

} // namespace ode::sound
