#include "mesh/quality.h"

#include "mesh/jacobian.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ode::soft {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

int find_root(std::vector<int>& parent, int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
        auto& p = parent[static_cast<std::size_t>(i)];
        p = parent[static_cast<std::size_t>(p)]; // path halving
        i = p;
    }
    return i;
}

std::size_t count_parts(const TetMesh& mesh) {
    std::vector<int> parent(mesh.node.size());
    std::iota(parent.begin(), parent.end(), 0);
    std::size_t parts = mesh.node.size();
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        const int root = find_root(parent, n[0]);
        for (const int other : n.subspan(1)) {
            const int r = find_root(parent, other);
            if (r != root) {
                parent[static_cast<std::size_t>(r)] = root;
                --parts;
            }
        }
    }
    return parts;
}

} // namespace

double tetrahedron_quality(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
    const Vec3 a = x1 - x0, b = x2 - x0, c = x3 - x0;
    const double edges = a.squaredNorm() + b.squaredNorm() + c.squaredNorm() +
                         (x2 - x1).squaredNorm() + (x3 - x1).squaredNorm() +
                         (x3 - x2).squaredNorm();
    const double v = a.cross(b).dot(c) / 6.0;
    return std::copysign(12.0 * std::cbrt(9.0 * v * v) / edges, v);
}

double element_quality(const TetMesh& mesh, std::size_t element) {
    const auto n = mesh.nodes_of(element);
    const auto x = [&](std::size_t i) -> const Vec3& {
        return mesh.node[static_cast<std::size_t>(n[i])];
    };
    return tetrahedron_quality(x(0), x(1), x(2), x(3));
}

MeshQuality measure_quality(const TetMesh& mesh) {
    MeshQuality q{};
    q.min_volume = q.min_edge = q.min_quality = kInfinity;
    q.low = Vec3::Constant(kInfinity);
    q.high = -q.low;
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const double volume = element_volume(mesh, e);
        q.volume += volume;
        q.min_volume = std::min(q.min_volume, volume);
        const double quality = element_quality(mesh, e);
        if (quality < q.min_quality) {
            q.min_quality = quality;
            q.worst = e;
        }
        const auto n = mesh.nodes_of(e);
        for (const auto& [i, j] : kTetEdge) {
            const Vec3& a = mesh.node[static_cast<std::size_t>(n[static_cast<std::size_t>(i)])];
            const Vec3& b = mesh.node[static_cast<std::size_t>(n[static_cast<std::size_t>(j)])];
            const double edge = (a - b).norm();
            q.min_edge = std::min(q.min_edge, edge);
            q.max_edge = std::max(q.max_edge, edge);
        }
    }
    for (const Vec3& x : mesh.node) {
        q.low = q.low.cwiseMin(x);
        q.high = q.high.cwiseMax(x);
    }
    q.parts = count_parts(mesh);
    return q;
}

} // namespace ode::soft
