#include "couple/soft_volume.h"

namespace ode::soft {
namespace {
std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
} // namespace

SoftVolume::SoftVolume(const TetMesh& mesh, const SoftSurface& surface) : surface_(surface) {
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        corner_.push_back({n[0], n[1], n[2], n[3]});
        Aabb& box = rest_.emplace_back();
        for (const int i : corner_.back())
            box.include(mesh.node[index(i)]);
    }
    tree_ = BoxTree(rest_);
}

Tet SoftVolume::at(int t, const NodeArray& position) const noexcept {
    const auto& [a, b, c, d] = corner(t);
    return {position[index(a)], position[index(b)], position[index(c)], position[index(d)]};
}

Aabb SoftVolume::box(int t, const NodeArray& position) const noexcept {
    Aabb box;
    for (const int n : corner(t))
        box.include(position[index(n)]);
    return box;
}

bool SoftVolume::are_neighbours(int t, int u) const noexcept {
    const double edge = surface_.nodes().mean_edge;
    return rest_[index(t)].distance2(rest_[index(u)]) < edge * edge;
}

void SoftVolume::refit(const NodeArray& position, unsigned long when) noexcept {
    if (fitted_ == when)
        return;
    fitted_ = when;
    tree_.refit([&](int t) { return box(t, position); });
}

} // namespace ode::soft
