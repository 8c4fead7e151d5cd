#include "mesh/crease.h"

#include "mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace ode::soft {

namespace {

using Triangles = std::vector<std::array<int, 3>>;

// A side of a facet: from its corner i to its corner i + 1.
struct Side {
    std::array<int, 2> node; // ascending
    std::size_t triangle;
    std::size_t local;
};

std::vector<Side> sort_sides(const Triangles& triangle) {
    std::vector<Side> side;
    side.reserve(3 * triangle.size());
    for (std::size_t t = 0; t < triangle.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(triangle[t][i], triangle[t][(i + 1) % 3]);
            side.push_back({{a, b}, t, i});
        }
    std::sort(side.begin(), side.end(), [](const Side& a, const Side& b) {
        return std::tie(a.node, a.triangle) < std::tie(b.node, b.triangle);
    });
    return side;
}

class Sets {
public:
    explicit Sets(std::size_t size) : parent_(size) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    std::size_t find(std::size_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) { parent_[find(b)] = find(a); }

private:
    std::vector<std::size_t> parent_;
};

// Corner of a facet at a node.
std::size_t corner_at(const Triangles& triangle, std::size_t t, int node) {
    const auto& c = triangle[t];
    return 3 * t + static_cast<std::size_t>(std::find(c.begin(), c.end(), node) - c.begin());
}

// Tangents of the circle through the ends of two crease edges that meet: each direction weighted
// with the inverse of its length. Corners, where the crease turns by the crease angle or forks,
// have none.
void set_tangents(const TetMesh& mesh, double crease_angle, CreasedSurface& out,
                  std::vector<bool>& on_crease) {
    std::vector<std::array<int, 2>> neighbour(mesh.node.size(), {-1, -1});
    std::vector<int> count(mesh.node.size());
    for (const FacetEdge& e : out.edge) {
        if (!e.crease)
            continue;
        for (std::size_t end = 0; end < 2; ++end) {
            const auto at = static_cast<std::size_t>(e.node[end]);
            on_crease[at] = true;
            if (count[at] < 2)
                neighbour[at][static_cast<std::size_t>(count[at])] = e.node[1 - end];
            ++count[at];
        }
    }
    for (std::size_t i = 0; i < mesh.node.size(); ++i) {
        if (count[i] != 2)
            continue;
        const Vec3 before = mesh.node[i] - mesh.node[static_cast<std::size_t>(neighbour[i][0])];
        const Vec3 behind = mesh.node[static_cast<std::size_t>(neighbour[i][1])] - mesh.node[i];
        if (before.dot(behind) > std::cos(crease_angle) * before.norm() * behind.norm())
            out.tangent[i] =
                (before / before.squaredNorm() + behind / behind.squaredNorm()).normalized();
    }
}

} // namespace

CreasedSurface divide_at_creases(const TetMesh& mesh, double crease_angle) {
    TetMesh corners;
    corners.node = mesh.node;
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e).first(4);
        corners.element.insert(corners.element.end(), n.begin(), n.end());
    }
    const Triangles triangle = extract_surface(corners).triangle;
    const auto x = [&](int node) -> const Vec3& {
        return mesh.node[static_cast<std::size_t>(node)];
    };
    std::vector<Vec3> normal;
    for (const auto& [a, b, c] : triangle)
        normal.push_back((x(b) - x(a)).cross(x(c) - x(a)));

    CreasedSurface out;
    out.tangent.resize(mesh.node.size());
    Sets fans(3 * triangle.size());
    std::vector<std::size_t> first_side;
    const std::vector<Side> side = sort_sides(triangle);
    for (std::size_t i = 0; i < side.size();) {
        std::size_t end = i + 1;
        while (end < side.size() && side[end].node == side[i].node)
            ++end;
        FacetEdge e{side[i].node, 0.0, true, {-1, -1}};
        if (end - i == 2) {
            const Vec3& n0 = normal[side[i].triangle];
            const Vec3& n1 = normal[side[i + 1].triangle];
            e.dihedral = std::atan2(n0.cross(n1).norm(), n0.dot(n1));
            e.crease = !(e.dihedral < crease_angle);
        }
        if (!e.crease)
            for (const int node : e.node)
                fans.join(corner_at(triangle, side[i].triangle, node),
                          corner_at(triangle, side[i + 1].triangle, node));
        out.edge.push_back(e);
        first_side.push_back(i);
        i = end;
    }
    std::vector<bool> on_crease(mesh.node.size());
    set_tangents(mesh, crease_angle, out, on_crease);

    std::vector<int> number(3 * triangle.size(), -1);
    const auto fan_of = [&](std::size_t corner) {
        int& n = number[fans.find(corner)];
        if (n < 0) {
            n = static_cast<int>(out.fan.size());
            out.fan.push_back({Vec3::Zero(), NormalRank::inner});
        }
        return static_cast<std::size_t>(n);
    };
    for (std::size_t t = 0; t < triangle.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const int node = triangle[t][i];
            const Vec3 u = x(triangle[t][(i + 1) % 3]) - x(node);
            const Vec3 v = x(triangle[t][(i + 2) % 3]) - x(node);
            Fan& fan = out.fan[fan_of(3 * t + i)];
            fan.normal += u.cross(v) / (u.squaredNorm() * v.squaredNorm());
            const auto at = static_cast<std::size_t>(node);
            if (on_crease[at])
                fan.rank = out.tangent[at] ? NormalRank::on_crease : NormalRank::raw;
        }
    std::vector<bool> done(out.fan.size());
    for (std::size_t t = 0; t < triangle.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t f = fan_of(3 * t + i);
            if (done[f])
                continue;
            done[f] = true;
            Vec3& n = out.fan[f].normal;
            if (const auto& along = out.tangent[static_cast<std::size_t>(triangle[t][i])]) {
                // Facets on one side of the node only must not tilt the normal along the crease.
                const Vec3 across = n - n.dot(*along) * *along;
                if (across.norm() > 0.5 * n.norm())
                    n = across;
            }
            n.normalize();
        }
    for (std::size_t e = 0; e < out.edge.size(); ++e)
        for (std::size_t end = 0; end < 2; ++end)
            out.edge[e].fan[end] = static_cast<int>(
                fan_of(corner_at(triangle, side[first_side[e]].triangle, out.edge[e].node[end])));
    return out;
}

} // namespace ode::soft
