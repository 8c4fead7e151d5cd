#include "transfer/transfer_table.h"

#include "transfer/coarsen.h"
#include "transfer/helmholtz.h"
#include "transfer/outgoing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ode::sound {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;
using Complex = std::complex<double>;

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

/// Volume that a mode moves outward, over the surface's area.
double mean_outflow(const ModalSurface& s, std::span<const Facet> facet, std::size_t mode) {
    const double* shape = s.shape.data() + 3 * mode * s.mesh.node.size();
    double flow = 0.0, area = 0.0;
    for (std::size_t t = 0; t < facet.size(); ++t) {
        Vec3 sum = Vec3::Zero();
        for (const int i : s.mesh.triangle[t])
            sum += Eigen::Map<const Vec3>(shape + 3 * i);
        flow += facet[t].area / 3.0 * sum.dot(facet[t].normal);
        area += facet[t].area;
    }
    return flow / area;
}

/// Adds a triangle by points a quarter of a wavelength apart at most.
/// @param p, q  pressure and its slope at the corners of every triangle, one column a wave.
void add_facet(OutgoingSum& sum, const Facet& f, Eigen::Index first, const Vec3& centre, double k,
               const Eigen::MatrixXcd& p, const Eigen::MatrixXcd& q) {
    const int cuts = std::max(1, static_cast<int>(std::ceil(k * f.size() / kTau * 2.0)));
    const double w = f.area / (3.0 * cuts * cuts);
    for (int a = 0; a < cuts; ++a)
        for (int b = 0; b < cuts; ++b)
            for (const Vec3& bary : three_points()) {
                // Sub-triangles upright (a + b < cuts), and turned over.
                const bool upright = a + b < cuts;
                const double u = upright ? a + bary[1] : cuts - a - bary[1];
                const double v = upright ? b + bary[2] : cuts - b - bary[2];
                const Vec3 place(1.0 - (u + v) / cuts, u / cuts, v / cuts);
                const Eigen::RowVectorXcd pressure = w * place.transpose() * p.middleRows<3>(first);
                const Eigen::RowVectorXcd slope = w * place.transpose() * q.middleRows<3>(first);
                const auto waves = static_cast<std::size_t>(p.cols());
                sum.add(f.at(place) - centre, f.normal, {pressure.data(), waves},
                        {slope.data(), waves});
            }
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
    const std::vector<Facet> fine = given.mesh.facets();
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
            slope.col(static_cast<Eigen::Index>(m - first)) =
                slope_of(s, facet, m, o.density).array() -
                o.density * (mean_outflow(given, fine, m) - mean_outflow(s, facet, m));
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
        const int order = OutgoingSum::order_for(k * table.radius);
        const std::vector<OutgoingSum::Wave> waves(end - first, {k, order});
        OutgoingSum sum(waves, table.radius);
        for (std::size_t t = 0; t < facet.size(); ++t)
            add_facet(sum, facet[t], static_cast<Eigen::Index>(3 * t), table.centre, k, pressure,
                      slope);
        for (std::size_t m = first; m < end; ++m)
            table.add(s.frequency[m], order, sum.on_sphere(m - first));
        first = end;
    }
    return table;
}

} // namespace ode::sound
