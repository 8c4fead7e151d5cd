#pragma once

#include "collide/box_tree.h"
#include "couple/soft_surface.h"
#include "couple/tet_overlap.h"
#include "mesh/tet_mesh.h"

#include <array>
#include <vector>

namespace ode::soft {

/// What the volume penalty needs of a body, made when it first meets another under it: tetrahedra
/// (the corners of quadratic ones) and a tree over them.
class SoftVolume {
public:
    /// Both borrowed.
    SoftVolume(const TetMesh& mesh, const SoftSurface& surface);

    const SoftSurface& surface() const noexcept { return surface_; }
    int size() const noexcept { return static_cast<int>(corner_.size()); }
    const std::array<int, 4>& corner(int t) const noexcept {
        return corner_[static_cast<std::size_t>(t)];
    }
    Tet at(int t, const NodeArray& position) const noexcept;
    Aabb box(int t, const NodeArray& position) const noexcept;
    /// Nearer to each other at rest than an edge of the surface.
    bool are_neighbours(int t, int u) const noexcept;

    /// Boxes as of the last refit(). @param when  names the state of motion.
    const BoxTree& tree() const noexcept { return tree_; }
    void refit(const NodeArray& position, unsigned long when) noexcept;

private:
    const SoftSurface& surface_;
    std::vector<std::array<int, 4>> corner_;
    std::vector<Aabb> rest_;
    BoxTree tree_;
    unsigned long fitted_ = 0;
};

} // namespace ode::soft
