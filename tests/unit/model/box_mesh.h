#pragma once

#include "mesh/tet_mesh.h"

#include <map>

namespace ode::soft {

/// Box from the origin, nx*ny*nz cells of six tetrahedra (Kuhn), nodes in lexicographic order, z
/// fastest.
inline TetMesh box_mesh(const Vec3& size, int nx, int ny, int nz) {
    TetMesh mesh;
    for (int i = 0; i <= nx; ++i)
        for (int j = 0; j <= ny; ++j)
            for (int k = 0; k <= nz; ++k)
                mesh.node.emplace_back(size.x() * i / nx, size.y() * j / ny, size.z() * k / nz);
    constexpr int kPath[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j)
            for (int k = 0; k < nz; ++k)
                for (int path = 0; path < 6; ++path) {
                    int at[3] = {i, j, k};
                    int node[4];
                    for (int c = 0; c < 4; ++c) {
                        node[c] = (at[0] * (ny + 1) + at[1]) * (nz + 1) + at[2];
                        if (c < 3)
                            ++at[kPath[path][c]];
                    }
                    if (path >= 3)
                        std::swap(node[1], node[2]);
                    mesh.element.insert(mesh.element.end(), node, node + 4);
                }
    return mesh;
}

/// The same with a node in the middle of each edge, numbered after the corners.
inline TetMesh with_mid_nodes(const TetMesh& linear) {
    TetMesh mesh = linear;
    mesh.order = 2;
    mesh.element.clear();
    std::map<std::pair<int, int>, int> mid;
    for (std::size_t e = 0; e < linear.element_count(); ++e) {
        const auto corner = linear.nodes_of(e);
        mesh.element.insert(mesh.element.end(), corner.begin(), corner.end());
        for (const auto& edge : kTetEdge) {
            const int a = corner[static_cast<std::size_t>(edge[0])];
            const int b = corner[static_cast<std::size_t>(edge[1])];
            const auto [at, is_new] =
                mid.try_emplace(std::minmax(a, b), static_cast<int>(mesh.node.size()));
            if (is_new)
                mesh.node.push_back(0.5 * (linear.node[static_cast<std::size_t>(a)] +
                                           linear.node[static_cast<std::size_t>(b)]));
            mesh.element.push_back(at->second);
        }
    }
    return mesh;
}

} // namespace ode::soft
