#include "couple/soft_surface.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ode::soft {
namespace {

constexpr double kCrease = 0.866; ///< cosine of the angle between the normals of a crease

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

/// Edges along which two triangles meet in a convex crease, ascending.
std::vector<std::array<int, 2>> find_creases(const SurfaceNodes& surface,
                                             std::span<const Vec3> rest) {
    std::map<std::pair<int, int>, std::vector<std::size_t>> edge;
    for (std::size_t t = 0; t < surface.triangle.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const int a = surface.triangle[t][i];
            const int b = surface.triangle[t][(i + 1) % 3];
            edge[std::minmax(a, b)].push_back(t);
        }
    const auto normal = [&](std::size_t t) -> Vec3 {
        const auto& [a, b, c] = surface.triangle[t];
        return (rest[index(b)] - rest[index(a)])
            .cross(rest[index(c)] - rest[index(a)])
            .stableNormalized();
    };
    std::vector<std::array<int, 2>> creases;
    for (const auto& [ends, sides] : edge) {
        if (sides.size() != 2 || normal(sides[0]).dot(normal(sides[1])) > kCrease)
            continue;
        double beyond = 0; // how far the second triangle rises over the first
        for (const int n : surface.triangle[sides[1]])
            beyond += normal(sides[0]).dot(rest[index(n)] - rest[index(ends.first)]);
        if (beyond < 0)
            creases.push_back({ends.first, ends.second});
    }
    return creases;
}

} // namespace

SoftSurface::SoftSurface(const SurfaceNodes& nodes, std::span<const Vec3> rest)
    : nodes_(nodes), rest_(rest) {
    const auto creases = find_creases(nodes, rest);
    std::vector<double> claims(rest.size(), 1);
    for (const auto& ends : creases)
        for (const int n : ends)
            ++claims[index(n)];
    std::vector<std::size_t> place(rest.size(), 0);
    for (std::size_t i = 0; i < nodes.node.size(); ++i) {
        const int n = nodes.node[i];
        place[index(n)] = i;
        const double share = 1 / claims[index(n)];
        point_.push_back({{n, n}, {1, 0}, share * nodes.area[i], share * nodes.mass[i]});
    }
    for (const auto& [a, b] : creases) {
        const std::size_t i = place[index(a)];
        const std::size_t k = place[index(b)];
        const double area = nodes.area[i] / claims[index(a)] + nodes.area[k] / claims[index(b)];
        const double mass =
            std::min(nodes.mass[i] / claims[index(a)], nodes.mass[k] / claims[index(b)]);
        point_.push_back({{a, b}, {0.5, 0.5}, area, 2 * mass});
    }
    std::vector<Aabb> box(nodes.triangle.size());
    for (std::size_t t = 0; t < box.size(); ++t)
        for (const int n : nodes.triangle[t])
            box[t].include(rest[index(n)]);
    tree_ = BoxTree(box);
}

void SoftSurface::refit(const NodeArray& position, unsigned long when) noexcept {
    if (fitted_ == when)
        return;
    fitted_ = when;
    tree_.refit([&](int t) {
        Aabb box = Aabb::empty();
        for (const int n : nodes_.triangle[index(t)])
            box.include(position[index(n)]);
        return box;
    });
}

} // namespace ode::soft
