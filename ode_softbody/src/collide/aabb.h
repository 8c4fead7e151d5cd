#pragma once

#include "base/types.h"

#include <limits>

namespace ode::soft {

/// Box along the world's axes [m]. Empty while low > high.
struct Aabb {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

    static Aabb empty() noexcept { return {}; }

    void include(const Vec3& point) noexcept {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    /// Moves every side outward [m].
    void grow(double margin) noexcept {
        low.array() -= margin;
        high.array() += margin;
    }
    bool is_empty() const noexcept { return !(low.array() <= high.array()).all(); }
    bool overlaps(const Aabb& other) const noexcept {
        return (low.array() <= other.high.array()).all() &&
               (other.low.array() <= high.array()).all();
    }
};

} // namespace ode::soft
