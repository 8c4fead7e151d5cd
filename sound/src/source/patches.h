#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ode::sound {

/// A surface's points in up to kMost groups of neighbours, which are seen or hidden as one.
struct Patches {
    static constexpr int kMost = 16;

    std::vector<std::uint8_t> of; ///< patch of every point
    int count = 0;

    Patches() = default;
    /// Halves the largest group across its longest axis until there are enough; a group keeps four
    /// points at least. @param point  x y z and padding each.
    Patches(const double* point, int points, int stride);

    /// Mean of each patch's points, x y z.
    void centres(const double* point, int stride, std::span<std::array<double, 3>> out) const;
};

} // namespace ode::sound
