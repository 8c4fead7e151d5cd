#include "modal/lagrange.h"

#include "mesh/tet_mesh.h"

#include <Eigen/Eigenvalues>

#include <array>
#include <cassert>
#include <cmath>

namespace ode::soft {
namespace {

/// Derivatives with respect to the four barycentric coordinates, taken as independent.
using Gradient4 = Eigen::Vector4d;

/// Numerators of the nodes' barycentric coordinates over 4: lagrange_points(4) times 4.
using Steps = std::array<int, 4>;

std::array<Steps, lagrange_nodes(4)> quartic_steps() {
    std::array<Steps, lagrange_nodes(4)> out{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 4; ++i)
        out[n++][i] = 4;
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    for (const auto& edge : kTetEdge)
        for (int k = 1; k < 4; ++k, ++n) {
            out[n][at(edge[0])] = 4 - k;
            out[n][at(edge[1])] = k;
        }
    for (const auto& face : kTetFace)
        for (std::size_t near = 0; near < 3; ++near, ++n)
            for (std::size_t k = 0; k < 3; ++k)
                out[n][at(face[k])] = k == near ? 2 : 1;
    out[n] = {1, 1, 1, 1};
    return out;
}

/// Silvester's product: the function of a node with steps s is the product over the corners of
/// R_s(l), R_s(l) = prod_{j < s} (4 l - j) / (j + 1), which is one at l = s / 4 (Silvester 1969).
template <class Emit>
void each_quartic(const Barycentric& l, Emit emit) {
    static const auto steps = quartic_steps();
    double r[4][5], slope[4][5];
    for (int i = 0; i < 4; ++i) {
        r[i][0] = 1;
        slope[i][0] = 0;
        for (int s = 0; s < 4; ++s) {
            const double factor = (4 * l[i] - s) / (s + 1);
            r[i][s + 1] = r[i][s] * factor;
            slope[i][s + 1] = slope[i][s] * factor + r[i][s] * 4 / (s + 1);
        }
    }
    for (const Steps& s : steps) {
        double value = 1;
        Gradient4 g = Gradient4::Ones();
        for (int i = 0; i < 4; ++i) {
            value *= r[i][s[static_cast<std::size_t>(i)]];
            for (int k = 0; k < 4; ++k)
                g[k] *= (k == i ? slope : r)[i][s[static_cast<std::size_t>(i)]];
        }
        emit(value, g);
    }
}

template <class Emit>
void each_function(int order, const Barycentric& l, Emit emit) {
    const auto unit = [](int i, double d) {
        Gradient4 g = Gradient4::Zero();
        g[i] = d;
        return g;
    };
    if (order == 1) {
        for (int i = 0; i < 4; ++i)
            emit(l[i], unit(i, 1));
        return;
    }
    if (order == 2) {
        for (int i = 0; i < 4; ++i)
            emit(l[i] * (2 * l[i] - 1), unit(i, 4 * l[i] - 1));
        for (const auto& edge : kTetEdge) {
            const int a = edge[0], b = edge[1];
            emit(4 * l[a] * l[b], unit(a, 4 * l[b]) + unit(b, 4 * l[a]));
        }
        return;
    }
    if (order == 4) {
        each_quartic(l, emit);
        return;
    }
    assert(order == 3);
    for (int i = 0; i < 4; ++i)
        emit(0.5 * l[i] * (3 * l[i] - 1) * (3 * l[i] - 2),
             unit(i, 0.5 * (27 * l[i] * l[i] - 18 * l[i] + 2)));
    for (const auto& edge : kTetEdge)
        for (int side = 0; side < 2; ++side) {
            const int a = edge[side], b = edge[1 - side]; // the node lies nearer a
            emit(4.5 * l[a] * l[b] * (3 * l[a] - 1),
                 unit(a, 4.5 * l[b] * (6 * l[a] - 1)) + unit(b, 4.5 * l[a] * (3 * l[a] - 1)));
        }
    for (const auto& face : kTetFace) {
        const int a = face[0], b = face[1], c = face[2];
        emit(27 * l[a] * l[b] * l[c],
             unit(a, 27 * l[b] * l[c]) + unit(b, 27 * l[a] * l[c]) + unit(c, 27 * l[a] * l[b]));
    }
}

/// Nodes and weights of the n-point Gauss-Legendre rule on [0, 1] (Golub and Welsch 1969).
std::vector<std::array<double, 2>> gauss_legendre(int n) {
    Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
    for (int i = 1; i < n; ++i)
        jacobi(i, i - 1) = jacobi(i - 1, i) = i / std::sqrt(4.0 * i * i - 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobi);
    std::vector<std::array<double, 2>> rule;
    for (int i = 0; i < n; ++i) {
        const double first = eigen.eigenvectors()(0, i);
        rule.push_back({0.5 * (1 + eigen.eigenvalues()[i]), first * first});
    }
    return rule;
}

void add_orbit4(std::vector<QuadraturePoint>& rule, double a, double weight) {
    for (int i = 0; i < 4; ++i) {
        Barycentric at = Barycentric::Constant(a);
        at[i] = 1 - 3 * a;
        rule.push_back({at, weight});
    }
}

} // namespace

void lagrange_value(int order, const Barycentric& at, std::span<double> value) {
    assert(value.size() >= static_cast<std::size_t>(lagrange_nodes(order)));
    std::size_t i = 0;
    each_function(order, at, [&](double v, const Gradient4&) { value[i++] = v; });
}

void lagrange_gradient(int order, const Barycentric& at, Eigen::Matrix3Xd& gradient) {
    gradient.resize(3, lagrange_nodes(order));
    int i = 0;
    each_function(order, at, [&](double, const Gradient4& g) {
        gradient.col(i++) = Vec3(g[1] - g[0], g[2] - g[0], g[3] - g[0]);
    });
}

std::vector<Barycentric> lagrange_points(int order) {
    std::vector<Barycentric> points;
    for (int i = 0; i < 4; ++i)
        points.push_back(Barycentric::Unit(i));
    if (order > 1)
        for (const auto& edge : kTetEdge)
            for (int k = 1; k < order; ++k)
                points.push_back(
                    (Barycentric::Unit(edge[0]) * (order - k) + Barycentric::Unit(edge[1]) * k) /
                    order);
    if (order == 3)
        for (int face = 0; face < 4; ++face)
            points.push_back((Barycentric::Ones() - Barycentric::Unit(face)) / 3);
    if (order == 4) {
        points.clear();
        for (const Steps& s : quartic_steps())
            points.push_back(Barycentric(s[0], s[1], s[2], s[3]) / 4);
    }
    return points;
}

std::vector<QuadraturePoint> tetrahedron_quadrature(int degree) {
    std::vector<QuadraturePoint> rule;
    if (degree <= 1) {
        rule.push_back({Barycentric::Constant(0.25), 1.0 / 6});
    } else if (degree == 2) {
        add_orbit4(rule, (5 - std::sqrt(5.0)) / 20, 1.0 / 24);
    } else if (degree <= 5) {
        add_orbit4(rule, 0.31088591926330060980, 0.018781320953002641800);
        add_orbit4(rule, 0.092735250310891226402, 0.012248840519393658257);
        constexpr double a = 0.045503704125649649492;
        for (const auto& edge : kTetEdge) {
            Barycentric at = Barycentric::Constant(a);
            at[edge[0]] = at[edge[1]] = 0.5 - a;
            rule.push_back({at, 0.0070910034628469110730});
        }
    } else if (degree == 6) {
        add_orbit4(rule, 0.21460287125915202929, 0.0066537917096945820166);
        add_orbit4(rule, 0.040673958534611353116, 0.0016795351758867738247);
        add_orbit4(rule, 0.32233789014227551034, 0.0092261969239424536825);
        constexpr double a = 0.063661001875017525299, b = 0.26967233145831580803;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                if (i != j) {
                    Barycentric at = Barycentric::Constant(a);
                    at[i] = b;
                    at[j] = 1 - 2 * a - b;
                    rule.push_back({at, 0.0080357142857142857143});
                }
    } else {
        // x = u, y = v (1-u), z = w (1-u)(1-v): the Jacobian adds two degrees in u.
        const auto line = gauss_legendre((degree + 4) / 2);
        for (const auto& [u, wu] : line)
            for (const auto& [v, wv] : line)
                for (const auto& [w, ww] : line) {
                    const double y = v * (1 - u), z = w * (1 - u) * (1 - v);
                    rule.push_back({Barycentric(1 - u - y - z, u, y, z),
                                    wu * wv * ww * (1 - u) * (1 - u) * (1 - v)});
                }
    }
    return rule;
}

} // namespace ode::soft
