#pragma once

#include "strike/struck_surface.h"

#include <array>
#include <cmath>

namespace ode::sound {

/// Places of a surface that were looked for lately: what bears, slides or rolls is met again at
/// every step where it was, or next to it.
class Spots {
public:
    /// As StruckSurface::nearest(), or what that answered to nearly the same question: as far off
    /// as modes do not tell.
    const StruckSurface::Place& find(const StruckSurface& surface, const Vec3& point,
                                     const Vec3& outward) noexcept {
        const double near = kNear * surface.radius();
        for (const Spot& own : spot_) {
            const double square = (point - own.point).squaredNorm();
            if (square < near * near && outward.dot(own.outward) > kAlike)
                return own.place;
        }
        next_ = (next_ + 1) % spot_.size();
        Spot& own = spot_[next_];
        own = {point, outward, surface.nearest(point, outward)};
        return own.place;
    }

private:
    static constexpr double kNear = 1e-3, kAlike = 0.99; ///< of the radius; cosine
    struct Spot {
        Vec3 point = Vec3::Constant(HUGE_VAL), outward = Vec3::Zero();
        StruckSurface::Place place;
    };
    std::array<Spot, 16> spot_;
    std::size_t next_ = 0;
};

} // namespace ode::sound
