#pragma once

#include "listen/ear_path.h"

#include <Eigen/Geometry>

#include <array>

namespace ode::sound {

/// Where a listener is and how it is turned. No axis of the world is taken to be up.
struct Pose {
    Vec3 centre = Vec3::Zero(); ///< midpoint between the ears [m]
    Vec3 right = Vec3::UnitX(); ///< unit: view direction x up
    double ear_distance = 0.2;  ///< [m]; P01 3.3

    /// @return false, and nothing changed, if either vector is zero, they are parallel, or not
    /// finite.
    bool orient(const Vec3& at, const Vec3& up) noexcept {
        const Vec3 side = at.normalized().cross(up.normalized());
        constexpr double kParallel = 1e-6; // sine of the angle: 0.2 arc seconds
        if (!(side.norm() > kParallel))
            return false;
        right = side.normalized();
        return true;
    }

    /// Left, right.
    std::array<Vec3, 2> ears() const noexcept {
        const Vec3 half = 0.5 * ear_distance * right;
        return {centre - half, centre + half};
    }
};

} // namespace ode::sound
