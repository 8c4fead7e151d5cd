#pragma once

#include "mix/scene.h"

#include <ode/ode.h>

namespace ode::sound {

/// Finds out what stands between bodies and ears, by rays through the application's own space.
///
/// Rays go from the middle of each patch of a surface to each ear, in turn, at a bounded rate; none
/// while nothing's box comes near the way. A body does not hide itself: the calibrated rules count
/// all its faces, and what goes round it is their business.
class Occlusion {
public:
    static constexpr double kRaysPerSecond = 4000.0; ///< of simulated time

    Occlusion() = default;
    Occlusion(const Occlusion&) = delete;
    Occlusion& operator=(const Occlusion&) = delete;
    ~Occlusion() { set(nullptr, 0); }

    /// @param space  null: nothing hides anything.
    /// @param hides  category bits of geoms that do.
    void set(dSpaceID space, unsigned long hides);

    /// After a step of `duration` [s]. Bodies' keys are dSoftBodyIDs.
    void update(Scene& scene, double duration);

    unsigned long rays() const noexcept { return rays_; }

private:
    bool may_hide(Scene& scene, const void* body, const dReal* low, const dReal* high) const;
    bool is_hidden(const void* body, const Vec3& from, const Vec3& to);

    dSpaceID space_ = nullptr;
    unsigned long hides_ = 0;
    dGeomID ray_ = nullptr;
    double credit_ = 0.0;    ///< rays that may be cast
    unsigned long turn_ = 0; ///< whose ray is next
    unsigned long rays_ = 0;
};

} // namespace ode::sound
