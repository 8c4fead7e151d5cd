#include "modal/modal_model.h"

#include <algorithm>
#include <numeric>

namespace ode::soft {

void sort_by_frequency(ModalModel& model) {
    if (std::is_sorted(model.frequency.begin(), model.frequency.end()))
        return;
    std::vector<std::size_t> rank(model.mode_count());
    std::iota(rank.begin(), rank.end(), std::size_t{0});
    std::stable_sort(rank.begin(), rank.end(), [&](std::size_t a, std::size_t b) {
        return model.frequency[a] < model.frequency[b];
    });
    const ModalModel old = model;
    for (std::size_t k = 0; k < rank.size(); ++k) {
        model.frequency[k] = old.frequency[rank[k]];
        if (!old.error_cents.empty())
            model.error_cents[k] = old.error_cents[rank[k]];
        const auto shape = old.shape_of(rank[k]);
        std::copy(shape.begin(), shape.end(),
                  model.shape.begin() + static_cast<std::ptrdiff_t>(k * shape.size()));
    }
}

} // namespace ode::soft
