#include "mesh/topology.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace ode::soft {

std::vector<ElementFace> sort_faces(const TetMesh& mesh) {
    std::vector<ElementFace> face;
    face.reserve(4 * mesh.element_count());
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        for (std::int8_t f = 0; f < 4; ++f) {
            std::array<int, 3> c;
            for (std::size_t i = 0; i < 3; ++i)
                c[i] = n[static_cast<std::size_t>(kTetFace[f][i])];
            bool even = true;
            const auto order = [&](std::size_t i, std::size_t j) {
                if (c[i] > c[j]) {
                    std::swap(c[i], c[j]);
                    even = !even;
                }
            };
            order(0, 1);
            order(1, 2);
            order(0, 1);
            face.push_back({c, static_cast<int>(e), f, even});
        }
    }
    std::sort(face.begin(), face.end(), [](const ElementFace& a, const ElementFace& b) {
        return std::tie(a.corner, a.element, a.local) < std::tie(b.corner, b.element, b.local);
    });
    return face;
}

EdgeList number_edges(const TetMesh& mesh) {
    struct Use {
        std::array<int, 2> edge;
        std::size_t slot; // 6 * element + local edge
    };
    std::vector<Use> use;
    use.reserve(6 * mesh.element_count());
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        for (const auto& [i, j] : kTetEdge) {
            const auto [a, b] =
                std::minmax(n[static_cast<std::size_t>(i)], n[static_cast<std::size_t>(j)]);
            use.push_back({{a, b}, use.size()});
        }
    }
    std::sort(use.begin(), use.end(), [](const Use& a, const Use& b) {
        return std::tie(a.edge, a.slot) < std::tie(b.edge, b.slot);
    });

    // first[slot] is the first slot of the same edge, so that numbers follow the elements.
    std::vector<std::size_t> first(use.size());
    for (std::size_t i = 0; i < use.size(); ++i) {
        const bool again = i > 0 && use[i].edge == use[i - 1].edge;
        first[use[i].slot] = again ? first[use[i - 1].slot] : use[i].slot;
    }

    EdgeList out;
    out.of_element.resize(use.size());
    for (std::size_t slot = 0; slot < use.size(); ++slot) {
        if (first[slot] != slot) {
            out.of_element[slot] = out.of_element[first[slot]];
            continue;
        }
        const auto n = mesh.nodes_of(slot / 6);
        const auto& [i, j] = kTetEdge[slot % 6];
        const auto [a, b] =
            std::minmax(n[static_cast<std::size_t>(i)], n[static_cast<std::size_t>(j)]);
        out.of_element[slot] = static_cast<int>(out.edge.size());
        out.edge.push_back({a, b});
    }
    return out;
}

} // namespace ode::soft
