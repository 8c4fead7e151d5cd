#include "source/patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ode::sound {

Patches::Patches(const double* point, int points, int stride)
    : of(static_cast<std::size_t>(points), 0) {
    std::vector<std::vector<int>> group(1, std::vector<int>(static_cast<std::size_t>(points)));
    std::iota(group[0].begin(), group[0].end(), 0);
    constexpr std::size_t kLeast = 4;
    while (group.size() < kMost) {
        const auto largest =
            std::max_element(group.begin(), group.end(),
                             [](const auto& a, const auto& b) { return a.size() < b.size(); });
        if (largest->size() < 2 * kLeast)
            break;
        std::array<double, 3> low, high;
        low.fill(HUGE_VAL);
        high.fill(-HUGE_VAL);
        for (const int i : *largest)
            for (std::size_t k = 0; k < 3; ++k) {
                const double x = point[i * stride + static_cast<int>(k)];
                low[k] = std::min(low[k], x);
                high[k] = std::max(high[k], x);
            }
        int axis = 0;
        for (int k = 1; k < 3; ++k)
            if (high[static_cast<std::size_t>(k)] - low[static_cast<std::size_t>(k)] >
                high[static_cast<std::size_t>(axis)] - low[static_cast<std::size_t>(axis)])
                axis = k;
        const auto middle = largest->begin() + static_cast<std::ptrdiff_t>(largest->size() / 2);
        std::nth_element(largest->begin(), middle, largest->end(), [&](int a, int b) {
            const double x = point[a * stride + axis], y = point[b * stride + axis];
            return x != y ? x < y : a < b;
        });
        std::vector<int> rest(middle, largest->end());
        largest->erase(middle, largest->end());
        group.push_back(std::move(rest)); // after the last use of `largest`
    }
    count = static_cast<int>(group.size());
    for (std::size_t g = 0; g < group.size(); ++g)
        for (const int i : group[g])
            of[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(g);
}

void Patches::centres(const double* point, int stride, std::span<std::array<double, 3>> out) const {
    std::array<int, kMost> members{};
    for (auto& centre : out)
        centre.fill(0.0);
    for (std::size_t i = 0; i < of.size(); ++i) {
        ++members[of[i]];
        for (std::size_t k = 0; k < 3; ++k)
            out[of[i]][k] += point[i * static_cast<std::size_t>(stride) + k];
    }
    for (std::size_t g = 0; g < static_cast<std::size_t>(count); ++g)
        for (double& x : out[g])
            x /= members[g];
}

} // namespace ode::sound
