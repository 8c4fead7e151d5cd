#include "source/surface.h"

#include "dsp/kernels.h"

#include <algorithm>

namespace ode::sound {

Surface::Surface(std::span<const int> triangle)
    : body_node_(triangle.begin(), triangle.end()), triangle_(triangle.size()) {
    std::sort(body_node_.begin(), body_node_.end());
    body_node_.erase(std::unique(body_node_.begin(), body_node_.end()), body_node_.end());
    std::transform(triangle.begin(), triangle.end(), triangle_.begin(), [this](int node) {
        const auto at = std::lower_bound(body_node_.begin(), body_node_.end(), node);
        return static_cast<int>(at - body_node_.begin());
    });
    real_nodes_ = nodes();
    while (body_node_.size() % 4 != 0)
        body_node_.push_back(body_node_.back());
}

void Surface::collect(const double* body_points, int stride, double* point) const noexcept {
    for (int i = 0; i < nodes(); ++i) {
        const double* from =
            body_points +
            static_cast<std::ptrdiff_t>(body_node_[static_cast<std::size_t>(i)]) * stride;
        std::copy_n(from, 3, point + 4 * i);
        point[4 * i + 3] = 0.0;
    }
}

void Surface::areas(const double* point, double* area) const noexcept {
    std::fill_n(area, 4 * nodes(), 0.0);
    kernels().areas(triangles(), triangle(), point, area);
}

} // namespace ode::sound
