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
    void include(const Aabb& other) noexcept {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }
    /// Squared distance to another box, 0 where they overlap [m^2].
    double distance2(const Aabb& other) const noexcept {
        return (low - other.high).cwiseMax(other.low - high).cwiseMax(0.0).squaredNorm();
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
