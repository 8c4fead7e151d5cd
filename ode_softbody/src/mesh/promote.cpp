#include "mesh/promote.h"

#include "mesh/topology.h"

namespace ode::soft {

TetMesh promote_to_quadratic(const TetMesh& mesh) {
    if (mesh.order == 2)
        return mesh;
    const EdgeList edges = number_edges(mesh);
    const auto corners = static_cast<int>(mesh.node.size());
    TetMesh out;
    out.order = 2;
    out.group = mesh.group;
    out.group_name = mesh.group_name;
    out.node = mesh.node;
    out.node.reserve(mesh.node.size() + edges.edge.size());
    for (const auto& [a, b] : edges.edge)
        out.node.push_back(0.5 * (mesh.node[static_cast<std::size_t>(a)] +
                                  mesh.node[static_cast<std::size_t>(b)]));
    out.element.reserve(10 * mesh.element_count());
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        out.element.insert(out.element.end(), n.begin(), n.end());
        for (std::size_t i = 0; i < 6; ++i)
            out.element.push_back(corners + edges.of_element[6 * e + i]);
    }
    return out;
}

TetMesh demote_to_linear(const TetMesh& mesh, std::size_t corners) {
    TetMesh out;
    out.group = mesh.group;
    out.group_name = mesh.group_name;
    out.node.assign(mesh.node.begin(), mesh.node.begin() + static_cast<std::ptrdiff_t>(corners));
    out.element.reserve(4 * mesh.element_count());
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e).first(4);
        out.element.insert(out.element.end(), n.begin(), n.end());
    }
    return out;
}

} // namespace ode::soft
