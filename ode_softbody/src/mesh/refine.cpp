#include "mesh/refine.h"

#include "mesh/octahedron.h"
#include "mesh/promote.h"

namespace ode::soft {

TetMesh refine_uniformly(const TetMesh& mesh) {
    if (mesh.order == 1)
        return refine_uniformly(promote_to_quadratic(mesh));
    TetMesh out;
    out.node = mesh.node;
    out.group_name = mesh.group_name;
    out.element.reserve(32 * mesh.element_count());
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        const auto mid = [&](int a, int b) { return n[static_cast<std::size_t>(kTetMid[a][b])]; };
        for (int c = 0; c < 4; ++c) {
            // Corner c keeps its place in the order, so that the orientation stays.
            for (int i = 0; i < 4; ++i)
                out.element.push_back(i == c ? n[static_cast<std::size_t>(c)] : mid(c, i));
        }
        cut_octahedron(out.node,
                       {{{mid(2, 3), mid(0, 1)}, {mid(3, 1), mid(0, 2)}, {mid(1, 2), mid(0, 3)}}},
                       out.element);
        if (!mesh.group.empty())
            out.group.insert(out.group.end(), 8, mesh.group[e]);
    }
    return out;
}

} // namespace ode::soft
