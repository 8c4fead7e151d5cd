#include "modal/assemble.h"

#include "base/error.h"
#include "modal/lagrange.h"
#include "model/check_solid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ode::soft {
namespace {

/// A quadrature rule with everything that doesn't depend on the element.
struct Rule {
    std::vector<QuadraturePoint> point;
    std::vector<Eigen::Matrix3Xd> geometry_gradient; ///< of the mesh's shape functions
    std::vector<Eigen::Matrix3Xd> gradient;          ///< of the displacement's
    std::vector<std::array<double, kMaxLagrangeNodes>> value;
};

Rule make_rule(int geometry_order, int order, int degree) {
    Rule rule;
    rule.point = tetrahedron_quadrature(degree);
    for (const QuadraturePoint& q : rule.point) {
        lagrange_gradient(geometry_order, q.at, rule.geometry_gradient.emplace_back());
        lagrange_gradient(order, q.at, rule.gradient.emplace_back());
        lagrange_value(order, q.at, rule.value.emplace_back());
    }
    return rule;
}

/// dx/d(local): column c is the derivative by the c-th local coordinate.
Mat3 jacobian(const TetMesh& mesh, std::size_t e, const Eigen::Matrix3Xd& gradient) {
    const auto n = mesh.nodes_of(e);
    Mat3 j = Mat3::Zero();
    for (Eigen::Index i = 0; i < gradient.cols(); ++i)
        j += mesh.node[static_cast<std::size_t>(n[static_cast<std::size_t>(i)])] *
             gradient.col(i).transpose();
    return j;
}

/// Straight edges are the rule even in quadratic meshes, and much cheaper to integrate over. A
/// middle that is off by 1e-12 of the edge is rounding.
bool is_curved(const TetMesh& mesh, std::size_t e) {
    const auto n = mesh.nodes_of(e);
    const auto at = [&](std::size_t i) -> const Vec3& {
        return mesh.node[static_cast<std::size_t>(n[i])];
    };
    for (std::size_t k = 0; mesh.order > 1 && k < 6; ++k) {
        const Vec3& a = at(static_cast<std::size_t>(kTetEdge[k][0]));
        const Vec3& b = at(static_cast<std::size_t>(kTetEdge[k][1]));
        if ((0.5 * (a + b) - at(4 + k)).squaredNorm() > 1e-24 * (a - b).squaredNorm())
            return true;
    }
    return false;
}

const Solid& solid_of(const TetMesh& mesh, std::span<const Solid> solids, std::size_t e) {
    return solids[mesh.group.empty() ? 0 : static_cast<std::size_t>(mesh.group[e])];
}

double checked_determinant(const Mat3& j, std::size_t e) {
    const double det = j.determinant();
    if (!(det > 0))
        throw InputError(format("element %zu is inverted or flat (Jacobian %.3g m^3 somewhere in "
                                "it): repair the mesh or straighten its curved edges",
                                e, det));
    return det;
}

void build_pattern(const DofMap& map, BlockSystem& s) {
    const std::size_t nodes = map.node_count(), elements = map.element_count();
    std::vector<int> use(nodes + 1, 0), element_of;
    for (const int node : map.element)
        ++use[static_cast<std::size_t>(node) + 1];
    for (std::size_t i = 0; i < nodes; ++i)
        use[i + 1] += use[i];
    element_of.resize(map.element.size());
    std::vector<int> fill(use.begin(), use.end() - 1);
    for (std::size_t e = 0; e < elements; ++e)
        for (const int node : map.nodes_of(e))
            element_of[static_cast<std::size_t>(fill[static_cast<std::size_t>(node)]++)] =
                static_cast<int>(e);
    s.start.assign(1, 0);
    std::vector<int> seen(nodes, -1), row;
    for (std::size_t i = 0; i < nodes; ++i) {
        row.clear();
        for (int k = use[i]; k < use[i + 1]; ++k)
            for (const int j :
                 map.nodes_of(static_cast<std::size_t>(element_of[static_cast<std::size_t>(k)])))
                if (seen[static_cast<std::size_t>(j)] != static_cast<int>(i)) {
                    seen[static_cast<std::size_t>(j)] = static_cast<int>(i);
                    row.push_back(j);
                }
        std::sort(row.begin(), row.end());
        s.column.insert(s.column.end(), row.begin(), row.end());
        s.start.push_back(static_cast<int>(s.column.size()));
    }
}

std::size_t pair_index(const BlockSystem& s, int i, int j) {
    const auto begin = s.column.begin() + s.start[static_cast<std::size_t>(i)];
    const auto end = s.column.begin() + s.start[static_cast<std::size_t>(i) + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, j) - s.column.begin());
}

/// int g_i g_j^T for i <= j, nine numbers a pair, and the element's mass matrix of unit density.
struct ElementIntegrals {
    std::array<Mat3, kMaxLagrangeNodes*(kMaxLagrangeNodes + 1) / 2> outer;
    Eigen::Matrix<double, kMaxLagrangeNodes, kMaxLagrangeNodes> mass;
    double volume;
};

void integrate_stiffness(const TetMesh& mesh, std::size_t e, const Rule& rule, int n,
                         ElementIntegrals& out) {
    std::fill_n(out.outer.begin(), n * (n + 1) / 2, Mat3(Mat3::Zero()));
    Eigen::Matrix<double, 3, kMaxLagrangeNodes> g;
    for (std::size_t q = 0; q < rule.point.size(); ++q) {
        const Mat3 j = jacobian(mesh, e, rule.geometry_gradient[q]);
        const double weight = rule.point[q].weight * checked_determinant(j, e);
        g.leftCols(n).noalias() = j.inverse().transpose() * rule.gradient[q];
        std::size_t pair = 0;
        for (int a = 0; a < n; ++a) {
            const Vec3 scaled = weight * g.col(a);
            for (int b = a; b < n; ++b)
                out.outer[pair++] += scaled * g.col(b).transpose();
        }
    }
}

void integrate_mass(const TetMesh& mesh, std::size_t e, const Rule& rule, int n,
                    ElementIntegrals& out) {
    out.mass.setZero();
    out.volume = 0;
    for (std::size_t q = 0; q < rule.point.size(); ++q) {
        const double weight = rule.point[q].weight *
                              checked_determinant(jacobian(mesh, e, rule.geometry_gradient[q]), e);
        const Eigen::Map<const Eigen::VectorXd> value(rule.value[q].data(), n);
        out.mass.topLeftCorner(n, n) += weight * value * value.transpose();
        out.volume += weight;
    }
}

void lump(ElementIntegrals& element, int n) {
    Eigen::VectorXd diagonal = element.mass.diagonal().head(n);
    diagonal *= element.volume / diagonal.sum(); // order 1: all alike, so a quarter each
    element.mass.topLeftCorner(n, n) = diagonal.asDiagonal();
}

} // namespace

void check_solids(const TetMesh& mesh, std::span<const Solid> solids) {
    const auto wanted =
        mesh.group.empty()
            ? std::size_t{1}
            : static_cast<std::size_t>(*std::max_element(mesh.group.begin(), mesh.group.end())) + 1;
    if (solids.size() < wanted)
        throw InputError(format("the mesh has %zu groups of elements but %zu materials were given: "
                                "give one for each group",
                                wanted, solids.size()));
    for (std::size_t i = 0; i < wanted; ++i)
        check_solid(solids[i], i < mesh.group_name.size() ? mesh.group_name[i] : "");
}

BlockSystem assemble(const TetMesh& mesh, const DofMap& map, std::span<const Solid> solids,
                     MassKind mass) {
    check_solids(mesh, solids);
    BlockSystem s;
    s.position = map.position;
    build_pattern(map, s);
    s.stiffness.assign(9 * s.column.size(), 0.0);
    s.mass.assign(s.column.size(), 0.0);

    // On straight elements the integrands are polynomials and these degrees exact. On curved ones
    // det J (degree 3) makes the mass integrand of degree 2p + 3; the stiffness is rational, and
    // two degrees more keep its quadrature error far below the discretisation error.
    const int p = map.order;
    const int n = map.nodes_per_element;
    const Rule stiffness[] = {make_rule(1, p, 2 * (p - 1)), make_rule(2, p, 2 * p)};
    const Rule inertia[] = {make_rule(1, p, 2 * p), make_rule(2, p, 2 * p + (p < 3 ? 2 : 0))};
    ElementIntegrals element;
    for (std::size_t e = 0; e < map.element_count(); ++e) {
        const std::size_t curved = p > 1 && is_curved(mesh, e);
        integrate_stiffness(mesh, e, stiffness[curved], n, element);
        integrate_mass(mesh, e, inertia[curved], n, element);
        if (mass == MassKind::kLumped)
            lump(element, n);
        const Solid& solid = solid_of(mesh, solids, e);
        const double lambda = solid.lambda(), mu = solid.mu();
        const auto nodes = map.nodes_of(e);
        std::size_t pair = 0;
        for (int a = 0; a < n; ++a)
            for (int b = a; b < n; ++b) {
                Mat3 g = element.outer[pair++];
                if (a == b)
                    g = (0.5 * (g + g.transpose())).eval(); // symmetric to the last bit
                const Mat3 k = lambda * g + mu * (g.transpose() + g.trace() * Mat3::Identity());
                const int i = nodes[static_cast<std::size_t>(a)];
                const int j = nodes[static_cast<std::size_t>(b)];
                const std::size_t ij = pair_index(s, i, j);
                const double m = solid.density * element.mass(a, b);
                Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&s.stiffness[9 * ij]) += k;
                s.mass[ij] += m;
                if (a == b)
                    continue;
                const std::size_t ji = pair_index(s, j, i);
                Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&s.stiffness[9 * ji]) +=
                    k.transpose();
                s.mass[ji] += m;
            }
    }
    return s;
}

MassProperties mass_properties(const TetMesh& mesh, std::span<const Solid> solids) {
    // Second moments of a quadratic geometry: degree 2 * 2 + 3 of det J = 7.
    const auto points = tetrahedron_quadrature(mesh.order > 1 ? 7 : 2);
    std::vector<Eigen::Matrix3Xd> gradient(points.size());
    std::vector<std::array<double, kMaxLagrangeNodes>> value(points.size());
    for (std::size_t q = 0; q < points.size(); ++q) {
        lagrange_gradient(mesh.order, points[q].at, gradient[q]);
        lagrange_value(mesh.order, points[q].at, value[q]);
    }
    MassProperties out;
    const Vec3 origin = mesh.node.empty() ? Vec3(Vec3::Zero()) : mesh.node[0];
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero(); // about `origin`, near the body, against cancellation
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        const double density = solid_of(mesh, solids, e).density;
        for (std::size_t q = 0; q < points.size(); ++q) {
            const double dv = points[q].weight * jacobian(mesh, e, gradient[q]).determinant();
            Vec3 x = -origin;
            for (std::size_t i = 0; i < n.size(); ++i)
                x += value[q][i] * mesh.node[static_cast<std::size_t>(n[i])];
            out.volume += dv;
            out.mass += density * dv;
            first += density * dv * x;
            second += density * dv * x * x.transpose();
        }
    }
    const Vec3 centre = first / out.mass;
    second -= out.mass * centre * centre.transpose();
    out.centre = origin + centre;
    out.inertia = second.trace() * Mat3::Identity() - second;
    return out;
}

} // namespace ode::soft
