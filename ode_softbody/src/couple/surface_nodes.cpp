#include "couple/surface_nodes.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace ode::soft {

SurfaceNodes::SurfaceNodes(const TetMesh& mesh, const Surface& surface,
                           std::span<const double> node_mass)
    : node(surface.node), area(surface.node.size(), 0.0), triangle(surface.triangle),
      fan_start_(mesh.node.size() + 1, 0) {
    std::vector<std::size_t> place(mesh.node.size(), 0);
    for (std::size_t i = 0; i < node.size(); ++i) {
        place[static_cast<std::size_t>(node[i])] = i;
        mass.push_back(node_mass[static_cast<std::size_t>(node[i])]);
    }
    double edges = 0;
    for (const auto& corners : surface.triangle) {
        const auto corner = [&](int i) -> const Vec3& {
            return mesh.node[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])];
        };
        const Vec3 e1 = corner(1) - corner(0);
        const Vec3 e2 = corner(2) - corner(0);
        for (const int n : corners)
            area[place[static_cast<std::size_t>(n)]] += e1.cross(e2).norm() / 6;
        side.push_back({(e2 - e1).norm(), e2.norm(), e1.norm()});
        edges += e1.norm() + e2.norm() + (e2 - e1).norm();
    }
    if (node.empty())
        return;
    for (const auto& t : triangle) {
        lightest.push_back(std::numeric_limits<double>::infinity());
        for (const int n : t) {
            lightest.back() = std::min(lightest.back(), node_mass[static_cast<std::size_t>(n)]);
            ++fan_start_[static_cast<std::size_t>(n) + 1];
        }
    }
    std::partial_sum(fan_start_.begin(), fan_start_.end(), fan_start_.begin());
    fan_.resize(fan_start_.back());
    std::vector<std::size_t> next(fan_start_.begin(), fan_start_.end() - 1);
    for (std::size_t t = 0; t < triangle.size(); ++t)
        for (const int n : triangle[t])
            fan_[next[static_cast<std::size_t>(n)]++] = static_cast<int>(t);
    mean_edge = edges / (3 * static_cast<double>(surface.triangle.size()));
    std::vector<double> ratio;
    for (std::size_t i = 0; i < node.size(); ++i)
        ratio.push_back(mass[i] / area[i]);
    const auto middle = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2);
    std::nth_element(ratio.begin(), middle, ratio.end());
    mass_per_area = *middle;
    shape = measure_shape(mesh, *this);
}

} // namespace ode::soft
