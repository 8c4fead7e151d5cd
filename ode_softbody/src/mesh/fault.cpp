#include "base/error.h"
#include "mesh/jacobian.h"
#include "mesh/quality.h"
#include "mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {

namespace {

using Fault = std::optional<MeshFault>;

Fault of_element(std::size_t e, std::string text) {
    return MeshFault{.element = e, .node = MeshFault::kNone, .text = std::move(text)};
}
Fault of_node(std::size_t n, std::string text) {
    return MeshFault{.element = MeshFault::kNone, .node = n, .text = std::move(text)};
}
Fault of_mesh(std::string text) {
    return MeshFault{MeshFault::kNone, MeshFault::kNone, std::move(text)};
}

Fault find_bad_size(const TetMesh& mesh) {
    const auto per = static_cast<std::size_t>(mesh.nodes_per_element());
    if (mesh.order != 1 && mesh.order != 2)
        return of_mesh(format(
            "has elements of order %d: give linear (1) or quadratic (2) tetrahedra", mesh.order));
    if (mesh.element.empty())
        return of_mesh("holds no tetrahedra: give at least one");
    if (mesh.element.size() % per != 0)
        return of_mesh(format("lists %zu node indices, not a multiple of %zu: give %zu an element",
                              mesh.element.size(), per, per));
    constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<int>::max());
    if (mesh.node.size() > kMost || mesh.element_count() > kMost / 6)
        return of_mesh(format("has %zu nodes and %zu elements, more than 32-bit indices reach: "
                              "coarsen it",
                              mesh.node.size(), mesh.element_count()));
    if (!mesh.group.empty() && mesh.group.size() != mesh.element_count())
        return of_mesh(format("names a group for %zu of %zu elements: give one each or none",
                              mesh.group.size(), mesh.element_count()));
    return {};
}

Fault find_bad_index(const TetMesh& mesh) {
    const auto count = static_cast<int>(mesh.node.size());
    std::vector<bool> used(mesh.node.size());
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        for (const int i : n) {
            if (i < 0 || i >= count)
                return of_element(e,
                                  format("uses node %d of a mesh of %d: give indices from 0 to %d",
                                         i, count, count - 1));
            used[static_cast<std::size_t>(i)] = true;
        }
        for (std::size_t i = 0; i < n.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (n[i] == n[j])
                    return of_element(
                        e, format("uses node %d twice: give %zu different nodes", n[i], n.size()));
        if (!mesh.group.empty() && (mesh.group[e] < 0 || static_cast<std::size_t>(mesh.group[e]) >=
                                                             mesh.group_name.size()))
            return of_element(e, format("is in group %d of %zu: give an index into the group names",
                                        mesh.group[e], mesh.group_name.size()));
    }
    const auto idle = std::find(used.begin(), used.end(), false);
    if (idle != used.end())
        return of_node(static_cast<std::size_t>(idle - used.begin()),
                       "belongs to no element and would have no mass: remove it");
    return {};
}

// det J of a curved element on nodes, face centres and centre. A sufficient test (all Bernstein
// coefficients positive) would refuse sound elements of other mesh generators.
double least_sampled_jacobian(const TetMesh& mesh, std::size_t e) {
    const auto b = jacobian_bernstein(mesh, e);
    const auto at = [&](const std::array<double, 4>& l) {
        double sum = 0.0;
        std::size_t k = 0;
        for (std::size_t i = 0; i < 4; ++i)
            sum += b[k++] * l[i] * l[i] * l[i];
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                if (i != j)
                    sum += 3.0 * b[k++] * l[i] * l[i] * l[j];
        for (std::size_t skip = 0; skip < 4; ++skip)
            sum += 6.0 * b[k++] * l[(skip + 1) % 4] * l[(skip + 2) % 4] * l[(skip + 3) % 4];
        return sum;
    };
    double least = at({0.25, 0.25, 0.25, 0.25});
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<double, 4> corner{}, face;
        corner[i] = 1.0;
        face.fill(1.0 / 3.0);
        face[i] = 0.0;
        least = std::min({least, at(corner), at(face)});
    }
    for (const auto& [i, j] : kTetEdge) {
        std::array<double, 4> mid{};
        mid[static_cast<std::size_t>(i)] = mid[static_cast<std::size_t>(j)] = 0.5;
        least = std::min(least, at(mid));
    }
    return least;
}

Fault find_bad_shape(const TetMesh& mesh) {
    for (std::size_t i = 0; i < mesh.node.size(); ++i) {
        const Vec3& x = mesh.node[i];
        if (!x.allFinite())
            return of_node(i,
                           format("is at (%g, %g, %g): give finite coordinates", x[0], x[1], x[2]));
    }
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const double quality = element_quality(mesh, e);
        if (!(std::abs(quality) >= kFlatQuality)) // catches overflow to NaN too
            return of_element(e, format("is flat (quality %.2g, at least %.0e is needed): move its "
                                        "nodes apart or remove it",
                                        quality, kFlatQuality));
        if (quality < 0.0)
            return of_element(e, format("is inverted (volume %.3g m^3): swap two of its nodes",
                                        element_volume(mesh, e)));
        if (mesh.order == 2 && !(least_sampled_jacobian(mesh, e) > 0.0))
            return of_element(e, "folds over itself: move its mid-edge nodes towards the middle of "
                                 "their edges");
    }
    return {};
}

Fault find_bad_face(const TetMesh& mesh) {
    const auto face = sort_faces(mesh);
    for (std::size_t i = 1; i < face.size(); ++i) {
        const ElementFace& a = face[i - 1];
        const ElementFace& b = face[i];
        if (a.corner != b.corner)
            continue;
        const auto e = static_cast<std::size_t>(b.element);
        if (i > 1 && face[i - 2].corner == b.corner)
            return of_element(e, format("is the third on face %d %d %d, after elements %d and %d: "
                                        "remove the one that is too many",
                                        b.corner[0], b.corner[1], b.corner[2], face[i - 2].element,
                                        a.element));
        // Neighbours lie on opposite sides, so that their outward windings differ.
        if (a.even == b.even)
            return of_element(e,
                              format("overlaps element %d behind their face %d %d %d: remove one "
                                     "of them",
                                     a.element, b.corner[0], b.corner[1], b.corner[2]));
    }
    return {};
}

Fault find_bad_mid_edge(const TetMesh& mesh) {
    const EdgeList edges = number_edges(mesh);
    std::vector<int> mid_of(edges.edge.size(), -1);
    std::vector<int> edge_of(mesh.node.size(), -1);
    std::vector<bool> corner(mesh.node.size());
    for (std::size_t e = 0; e < mesh.element_count(); ++e)
        for (const int c : mesh.nodes_of(e).first(4))
            corner[static_cast<std::size_t>(c)] = true;
    for (std::size_t slot = 0; slot < edges.of_element.size(); ++slot) {
        const std::size_t e = slot / 6;
        const int edge = edges.of_element[slot];
        const auto& [a, b] = edges.edge[static_cast<std::size_t>(edge)];
        const int node = mesh.nodes_of(e)[4 + slot % 6];
        int& mid = mid_of[static_cast<std::size_t>(edge)];
        int& owner = edge_of[static_cast<std::size_t>(node)];
        if (corner[static_cast<std::size_t>(node)])
            return of_element(e,
                              format("has node %d in the middle of edge %d %d, which is a corner "
                                     "elsewhere: give quadratic neighbours the same nodes",
                                     node, a, b));
        if ((mid >= 0 && mid != node) || (owner >= 0 && owner != edge))
            return of_element(e, format("does not share the mid-edge node of edge %d %d with its "
                                        "neighbours: give each edge one node of its own",
                                        a, b));
        mid = node;
        owner = edge;
    }
    return {};
}

} // namespace

std::optional<MeshFault> find_fault(const TetMesh& mesh) {
    if (Fault f = find_bad_size(mesh))
        return f;
    if (Fault f = find_bad_index(mesh))
        return f;
    if (Fault f = find_bad_shape(mesh))
        return f;
    if (Fault f = find_bad_face(mesh))
        return f;
    return mesh.order == 2 ? find_bad_mid_edge(mesh) : Fault{};
}

void check_mesh(const TetMesh& mesh, const std::string& name) {
    const auto fault = find_fault(mesh);
    if (!fault)
        return;
    if (fault->element != MeshFault::kNone)
        throw InputError(
            format("%s: element %zu %s", name.c_str(), fault->element, fault->text.c_str()));
    if (fault->node != MeshFault::kNone)
        throw InputError(format("%s: node %zu %s", name.c_str(), fault->node, fault->text.c_str()));
    throw InputError(format("%s: the mesh %s", name.c_str(), fault->text.c_str()));
}

} // namespace ode::soft
