#include "mesh/surface.h"

#include "base/error.h"
#include "mesh/topology.h"

namespace ode::soft {

namespace {

// inner[4 e + f]: a second element shares face f of element e.
std::vector<bool> find_inner_faces(const TetMesh& mesh) {
    const auto face = sort_faces(mesh);
    std::vector<bool> inner(face.size());
    const auto slot = [](const ElementFace& f) {
        return 4 * static_cast<std::size_t>(f.element) + static_cast<std::size_t>(f.local);
    };
    for (std::size_t i = 1; i < face.size(); ++i) {
        if (face[i].corner != face[i - 1].corner)
            continue;
        if (inner[slot(face[i - 1])])
            throw InputError(format("element %d is the third on face %d %d %d: remove the one that "
                                    "is too many",
                                    face[i].element, face[i].corner[0], face[i].corner[1],
                                    face[i].corner[2]));
        inner[slot(face[i])] = inner[slot(face[i - 1])] = true;
    }
    return inner;
}

} // namespace

Surface extract_surface(const TetMesh& mesh) {
    const auto inner = find_inner_faces(mesh);
    Surface out;
    std::vector<bool> used(mesh.node.size());
    const auto add = [&](int a, int b, int c) {
        out.triangle.push_back({a, b, c});
        for (const int i : {a, b, c})
            used[static_cast<std::size_t>(i)] = true;
    };
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        const auto node = [&](int i) { return n[static_cast<std::size_t>(i)]; };
        for (std::size_t f = 0; f < 4; ++f) {
            if (inner[4 * e + f])
                continue;
            const auto& [a, b, c] = kTetFace[f];
            if (mesh.order == 1) {
                add(node(a), node(b), node(c));
                continue;
            }
            const int ab = node(kTetMid[a][b]), bc = node(kTetMid[b][c]), ca = node(kTetMid[c][a]);
            add(node(a), ab, ca);
            add(ab, node(b), bc);
            add(ca, bc, node(c));
            add(ab, bc, ca);
        }
    }
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i])
            out.node.push_back(static_cast<int>(i));
    return out;
}

} // namespace ode::soft
