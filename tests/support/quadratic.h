#pragma once

#include "mesh/tet_mesh.h"
#include "modal/dof_map.h"
#include "modal/lagrange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace ode::soft {

/// Straight quadratic elements on a linear mesh: mid-edge nodes follow the corners.
inline TetMesh to_quadratic(const TetMesh& linear) {
    TetMesh out = linear;
    out.order = 2;
    out.element.clear();
    std::map<std::pair<int, int>, int> mid;
    for (std::size_t e = 0; e < linear.element_count(); ++e) {
        const auto n = linear.nodes_of(e);
        out.element.insert(out.element.end(), n.begin(), n.end());
        for (const auto& [i, j] : kTetEdge) {
            const int a = n[static_cast<std::size_t>(i)], b = n[static_cast<std::size_t>(j)];
            const auto [place, fresh] =
                mid.try_emplace(std::minmax(a, b), static_cast<int>(out.node.size()));
            if (fresh)
                out.node.push_back(0.5 * (linear.node[static_cast<std::size_t>(a)] +
                                          linear.node[static_cast<std::size_t>(b)]));
            out.element.push_back(place->second);
        }
    }
    return out;
}

/// Pushes each mid-edge node by up to `amount` [m] in a direction that varies from node to node.
inline TetMesh bent(TetMesh quadratic, double amount) {
    std::vector<char> moved(quadratic.node.size(), 0);
    for (std::size_t e = 0; e < quadratic.element_count(); ++e)
        for (const int i : quadratic.nodes_of(e).subspan(4))
            if (!std::exchange(moved[static_cast<std::size_t>(i)], 1))
                quadratic.node[static_cast<std::size_t>(i)] +=
                    amount * Vec3(std::sin(1.0 * i), std::sin(2.0 * i), std::cos(3.0 * i)) / 2;
    return quadratic;
}

/// One flag a node: it lies on a face that only one element has.
inline std::vector<char> boundary_nodes(const DofMap& map) {
    std::map<std::array<int, 3>, int> uses;
    const auto key_of = [&](std::size_t e, int f) {
        std::array<int, 3> key;
        for (std::size_t k = 0; k < 3; ++k)
            key[k] = map.nodes_of(e)[static_cast<std::size_t>(kTetFace[f][k])];
        std::sort(key.begin(), key.end());
        return key;
    };
    for (std::size_t e = 0; e < map.element_count(); ++e)
        for (int f = 0; f < 4; ++f)
            ++uses[key_of(e, f)];
    std::vector<char> out(map.node_count(), 0);
    for (std::size_t e = 0; e < map.element_count(); ++e)
        for (int f = 0; f < 4; ++f) {
            if (uses[key_of(e, f)] != 1)
                continue;
            const auto n = map.nodes_of(e);
            for (std::size_t k = 0; k < 4; ++k)
                if (static_cast<int>(k) != f)
                    out[static_cast<std::size_t>(n[k])] = 1;
            std::size_t k = 4;
            for (const auto& [a, b] : kTetEdge)
                for (int j = 1; j < map.order; ++j, ++k)
                    if (a != f && b != f)
                        out[static_cast<std::size_t>(n[k])] = 1;
            const int inside = lagrange_face_nodes(map.order);
            for (int j = 0; j < inside; ++j)
                out[static_cast<std::size_t>(
                    n[static_cast<std::size_t>(4 + 6 * (map.order - 1) + inside * f + j)])] = 1;
        }
    return out;
}

} // namespace ode::soft
