#include "mesh/jacobian.h"

#include <algorithm>
#include <numeric>

namespace ode::soft {

namespace {

double corner_determinant(const TetMesh& mesh, std::size_t element) {
    const auto n = mesh.nodes_of(element);
    const auto x = [&](std::size_t i) { return mesh.node[static_cast<std::size_t>(n[i])]; };
    return (x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0));
}

// Gradient of the quadratic map at corner i, columns d/dl_1 - d/dl_0 and so on: the shape functions
// l_a (2 l_a - 1) and 4 l_a l_b leave dx/dl_i = 3 x_i and dx/dl_a = 4 x_ai - x_a at l_i = 1.
Mat3 corner_gradient(const TetMesh& mesh, std::span<const int> n, int corner) {
    const auto slope = [&](int a) -> Vec3 {
        const Vec3& x = mesh.node[static_cast<std::size_t>(n[static_cast<std::size_t>(a)])];
        if (a == corner)
            return 3.0 * x;
        const auto mid = static_cast<std::size_t>(kTetMid[a][corner]);
        return 4.0 * mesh.node[static_cast<std::size_t>(n[mid])] - x;
    };
    Mat3 j;
    for (int c = 0; c < 3; ++c)
        j.col(c) = slope(c + 1) - slope(0);
    return j;
}

} // namespace

std::array<double, 20> jacobian_bernstein(const TetMesh& mesh, std::size_t element) {
    std::array<double, 20> b;
    if (mesh.order == 1) {
        b.fill(corner_determinant(mesh, element));
        return b;
    }
    const auto n = mesh.nodes_of(element);
    std::array<Mat3, 4> g;
    for (int i = 0; i < 4; ++i)
        g[static_cast<std::size_t>(i)] = corner_gradient(mesh, n, i);
    const auto mixed = [&](std::size_t i, std::size_t j, std::size_t k) {
        return g[i].col(0).dot(g[j].col(1).cross(g[k].col(2)));
    };
    std::size_t at = 0;
    for (std::size_t i = 0; i < 4; ++i)
        b[at++] = mixed(i, i, i);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            if (i != j)
                b[at++] = (mixed(i, i, j) + mixed(i, j, i) + mixed(j, i, i)) / 3.0;
    for (std::size_t skip = 0; skip < 4; ++skip) {
        const std::size_t i = (skip + 1) % 4, j = (skip + 2) % 4, k = (skip + 3) % 4;
        b[at++] = (mixed(i, j, k) + mixed(i, k, j) + mixed(j, i, k) + mixed(j, k, i) +
                   mixed(k, i, j) + mixed(k, j, i)) /
                  6.0;
    }
    return b;
}

double relative_jacobian(const TetMesh& mesh, std::size_t element) {
    const auto b = jacobian_bernstein(mesh, element);
    return *std::min_element(b.begin(), b.end()) / corner_determinant(mesh, element);
}

double element_volume(const TetMesh& mesh, std::size_t element) {
    if (mesh.order == 1)
        return corner_determinant(mesh, element) / 6.0;
    // Each cubic Bernstein polynomial integrates to a twentieth of the reference volume 1/6.
    const auto b = jacobian_bernstein(mesh, element);
    return std::accumulate(b.begin(), b.end(), 0.0) / 120.0;
}

} // namespace ode::soft
