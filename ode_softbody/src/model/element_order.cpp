#include "model/element_order.h"

#include "base/error.h"

#include <algorithm>

namespace ode::soft {

std::vector<std::vector<int>> order_elements(const TetMesh& mesh, std::size_t solids) {
    std::vector<std::vector<int>> order(solids);
    std::vector<int> least(mesh.element_count());
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto node = mesh.nodes_of(e);
        least[e] = *std::min_element(node.begin(), node.end());
        const std::size_t group = mesh.group.empty() ? 0 : static_cast<std::size_t>(mesh.group[e]);
        if (group >= solids)
            throw InputError(format("element %zu belongs to group %zu, but only %zu solids were "
                                    "given: give one for each group",
                                    e, group, solids));
        order[group].push_back(static_cast<int>(e));
    }
    for (auto& list : order)
        std::stable_sort(list.begin(), list.end(), [&](int a, int b) {
            return least[static_cast<std::size_t>(a)] < least[static_cast<std::size_t>(b)];
        });
    return order;
}

} // namespace ode::soft
