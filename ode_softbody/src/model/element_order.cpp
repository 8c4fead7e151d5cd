#include "model/element_order.h"

#include "base/error.h"

#include <algorithm>
#include <numeric>

namespace ode::soft {
namespace {

std::vector<int> least_nodes(const TetMesh& mesh) {
    std::vector<int> out(mesh.element_count());
    for (std::size_t e = 0; e < out.size(); ++e) {
        const auto node = mesh.nodes_of(e);
        out[e] = *std::min_element(node.begin(), node.end());
    }
    return out;
}

/// Of each element along the longest side of the mesh's box: four times its corners' mean [m].
std::vector<double> places(const TetMesh& mesh) {
    Vec3 low = mesh.node.front(), high = low;
    for (const Vec3& x : mesh.node) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    std::vector<double> out(mesh.element_count());
    for (std::size_t e = 0; e < out.size(); ++e)
        for (const int corner : mesh.nodes_of(e).first(4))
            out[e] += mesh.node[static_cast<std::size_t>(corner)][axis];
    return out;
}

template <class Key>
std::vector<int> sorted_by(const std::vector<Key>& key) {
    std::vector<int> order(key.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return key[static_cast<std::size_t>(a)] < key[static_cast<std::size_t>(b)];
    });
    return order;
}

/// Slab of each element, when `order` is cut into so many of equal size.
std::vector<std::size_t> cut(std::span<const int> order, std::size_t slabs) {
    std::vector<std::size_t> out(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        out[static_cast<std::size_t>(order[i])] = i * slabs / order.size();
    return out;
}

bool only_neighbours_meet(const TetMesh& mesh, std::span<const std::size_t> slab_of) {
    std::vector<std::size_t> first(mesh.node.size(), kMostSlabs), last(mesh.node.size(), 0);
    for (std::size_t e = 0; e < slab_of.size(); ++e)
        for (const int node : mesh.nodes_of(e)) {
            const auto n = static_cast<std::size_t>(node);
            first[n] = std::min(first[n], slab_of[e]);
            last[n] = std::max(last[n], slab_of[e]);
        }
    for (std::size_t n = 0; n < first.size(); ++n)
        if (last[n] > first[n] + 1)
            return false;
    return true;
}

/// Slab of each element, as many as can be: cut by node numbers where these go along the mesh, as
/// then each slab is one stretch of memory; else along its longest side.
std::vector<std::size_t> choose_cut(const TetMesh& mesh, std::span<const int> by_node,
                                    std::size_t least) {
    std::size_t most = 1;
    while (most < kMostSlabs && mesh.element_count() >= 2 * most * least)
        most *= 2;
    for (std::size_t slabs = most; slabs >= 4; slabs /= 2) {
        std::vector<std::size_t> slab_of = cut(by_node, slabs);
        if (only_neighbours_meet(mesh, slab_of))
            return slab_of;
        slab_of = cut(sorted_by(places(mesh)), slabs);
        if (only_neighbours_meet(mesh, slab_of))
            return slab_of;
    }
    return std::vector<std::size_t>(mesh.element_count(), 0);
}

} // namespace

std::vector<ElementSlab> order_elements(const TetMesh& mesh, std::size_t solids,
                                        std::size_t least) {
    const std::vector<int> by_node = sorted_by(least_nodes(mesh));
    const std::vector<std::size_t> slab_of = choose_cut(mesh, by_node, least);
    const std::size_t slabs =
        slab_of.empty() ? 1 : *std::max_element(slab_of.begin(), slab_of.end()) + 1;
    std::vector<ElementSlab> out(slabs, {std::vector<std::vector<int>>(solids)});
    for (const int element : by_node) {
        const auto e = static_cast<std::size_t>(element);
        const std::size_t group = mesh.group.empty() ? 0 : static_cast<std::size_t>(mesh.group[e]);
        if (group >= solids)
            throw InputError(format("element %zu belongs to group %zu, but only %zu solids were "
                                    "given: give one for each group",
                                    e, group, solids));
        out[slab_of[e]].of_solid[group].push_back(element);
    }
    return out;
}

} // namespace ode::soft
