#include "modal/dof_map.h"

#include "base/error.h"
#include "modal/lagrange.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

using Key = std::array<int, 3>; ///< sorted mesh corners; an edge has -1 first

Key key_of(int a, int b, int c = -1) {
    Key key{a, b, c};
    std::sort(key.begin(), key.end());
    return key;
}

/// Sorted distinct keys; an index into it numbers the edges or faces.
std::vector<Key> distinct(std::vector<Key> keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

int index_of(const std::vector<Key>& keys, const Key& key) {
    return static_cast<int>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
}

/// Nodes of `target` expressed by the functions of `source` in each element; the first element that
/// holds a target node decides (the functions are continuous, so all agree).
template <class TargetNodes>
void express(const DofMap& source, int target_order, std::size_t target_count,
             TargetNodes target_nodes, std::vector<int>& start, std::vector<DofMap::Term>& term) {
    const auto points = lagrange_points(target_order);
    std::vector<std::array<double, kMaxLagrangeNodes>> weight(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        lagrange_value(source.order, points[i], weight[i]);
    std::vector<std::pair<std::size_t, std::size_t>> home(target_count, {SIZE_MAX, 0});
    for (std::size_t e = 0; e < source.element_count(); ++e) {
        const std::span<const int> nodes = target_nodes(e);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (auto& h = home[static_cast<std::size_t>(nodes[i])]; h.first == SIZE_MAX)
                h = {e, i};
    }
    start.assign(1, 0);
    term.clear();
    for (const auto& [e, i] : home) {
        if (e != SIZE_MAX)
            for (std::size_t k = 0; k < static_cast<std::size_t>(source.nodes_per_element); ++k)
                if (std::abs(weight[i][k]) > 1e-12) // nodal values are multiples of 1/27, or zero
                    term.push_back({source.nodes_of(e)[k], weight[i][k]});
        start.push_back(static_cast<int>(term.size()));
    }
}

} // namespace

DofMap number_nodes(const TetMesh& mesh, int order) {
    DofMap map;
    map.order = order;
    map.nodes_per_element = lagrange_nodes(order);
    const std::size_t elements = mesh.element_count();

    std::vector<int> corner(mesh.node.size(), -1);
    for (std::size_t e = 0; e < elements; ++e)
        for (int i = 0; i < 4; ++i)
            corner[static_cast<std::size_t>(mesh.nodes_of(e)[static_cast<std::size_t>(i)])] = 0;
    int next = 0;
    for (int& c : corner)
        if (c == 0)
            c = next++;

    std::vector<Key> edges, faces;
    for (std::size_t e = 0; e < elements && order > 1; ++e) {
        const auto n = mesh.nodes_of(e);
        for (const auto& [a, b] : kTetEdge)
            edges.push_back(key_of(n[static_cast<std::size_t>(a)], n[static_cast<std::size_t>(b)]));
        if (order > 2)
            for (const auto& [a, b, c] : kTetFace)
                faces.push_back(key_of(n[static_cast<std::size_t>(a)],
                                       n[static_cast<std::size_t>(b)],
                                       n[static_cast<std::size_t>(c)]));
    }
    edges = distinct(std::move(edges));
    faces = distinct(std::move(faces));
    const int per_edge = order - 1;
    const int first_face = next + per_edge * static_cast<int>(edges.size());
    const int per_face = lagrange_face_nodes(order);
    const int first_inner = first_face + per_face * static_cast<int>(faces.size());
    map.position.resize(static_cast<std::size_t>(first_inner) + (order > 3 ? elements : 0));
    map.element.reserve(elements * static_cast<std::size_t>(map.nodes_per_element));

    const auto points = lagrange_points(order);
    std::array<double, kMaxLagrangeNodes> geometry{};
    for (std::size_t e = 0; e < elements; ++e) {
        const auto n = mesh.nodes_of(e);
        for (int i = 0; i < 4; ++i)
            map.element.push_back(corner[static_cast<std::size_t>(n[static_cast<std::size_t>(i)])]);
        if (order > 1)
            for (const auto& [i, j] : kTetEdge) {
                const int a = n[static_cast<std::size_t>(i)], b = n[static_cast<std::size_t>(j)];
                const int base = next + per_edge * index_of(edges, key_of(a, b));
                for (int k = 0; k < per_edge;
                     ++k) // counted from the lower corner, in every element
                    map.element.push_back(base + (a < b ? k : per_edge - 1 - k));
            }
        if (order > 2)
            for (const auto& face : kTetFace) {
                const auto corner_of = [&](std::size_t k) {
                    return n[static_cast<std::size_t>(face[k])];
                };
                const Key key = key_of(corner_of(0), corner_of(1), corner_of(2));
                const int base = first_face + per_face * index_of(faces, key);
                for (int k = 0; k < per_face; ++k) // by the rank of the corner that it is nearest
                    map.element.push_back(
                        base +
                        (per_face == 1
                             ? 0
                             : static_cast<int>(std::find(key.begin(), key.end(),
                                                          corner_of(static_cast<std::size_t>(k))) -
                                                key.begin())));
            }
        if (order > 3)
            map.element.push_back(first_inner + static_cast<int>(e));
        const auto own = map.nodes_of(e);
        for (std::size_t i = 0; i < points.size(); ++i) {
            lagrange_value(mesh.order, points[i], geometry);
            Vec3 x = Vec3::Zero();
            for (std::size_t k = 0; k < n.size(); ++k)
                x += geometry[k] * mesh.node[static_cast<std::size_t>(n[k])];
            map.position[static_cast<std::size_t>(own[i])] = x;
        }
    }
    express(
        map, mesh.order, mesh.node.size(), [&](std::size_t e) { return mesh.nodes_of(e); },
        map.mesh_start, map.mesh_term);
    return map;
}

std::vector<char> clamped_nodes(const TetMesh& mesh, const DofMap& map,
                                std::span<const int> mesh_nodes) {
    std::vector<char> listed(mesh.node.size(), 0);
    for (const int node : mesh_nodes) {
        if (node < 0 || static_cast<std::size_t>(node) >= mesh.node.size())
            throw InputError(format("clamped node %d is not in the mesh, whose %zu nodes are "
                                    "numbered from 0",
                                    node, mesh.node.size()));
        listed[static_cast<std::size_t>(node)] = 1;
    }
    const auto held = [&](std::span<const int> n, std::size_t i) {
        return listed[static_cast<std::size_t>(n[i])] != 0;
    };
    std::vector<char> clamped(map.node_count(), 0);
    for (std::size_t e = 0; e < map.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        const auto own = map.nodes_of(e);
        std::size_t k = 0;
        for (; k < 4; ++k)
            clamped[static_cast<std::size_t>(own[k])] = held(n, k);
        bool edge_held[6];
        for (std::size_t i = 0; i < 6; ++i) {
            edge_held[i] = held(n, static_cast<std::size_t>(kTetEdge[i][0])) &&
                           held(n, static_cast<std::size_t>(kTetEdge[i][1])) &&
                           (mesh.order == 1 || held(n, 4 + i));
            for (int j = 1; j < map.order; ++j, ++k)
                clamped[static_cast<std::size_t>(own[k])] = edge_held[i];
        }
        for (std::size_t f = 0; f < 4 && map.order > 2; ++f) {
            bool all = true;
            for (std::size_t i = 0; i < 6; ++i)
                if (kTetEdge[i][0] != static_cast<int>(f) && kTetEdge[i][1] != static_cast<int>(f))
                    all = all && edge_held[i];
            for (int j = 0; j < lagrange_face_nodes(map.order); ++j, ++k)
                clamped[static_cast<std::size_t>(own[k])] = all;
        }
    }
    return clamped;
}

Prolongation prolongate(const DofMap& coarse, const DofMap& fine) {
    Prolongation out;
    express(
        coarse, fine.order, fine.node_count(), [&](std::size_t e) { return fine.nodes_of(e); },
        out.start, out.term);
    return out;
}

} // namespace ode::soft
