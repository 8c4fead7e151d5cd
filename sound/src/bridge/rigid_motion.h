#pragma once

#include "strike/struck_surface.h"

#include <Eigen/Geometry>
#include <ode/ode.h>

namespace ode::sound {

/// A rigid body of ODE's at the beginning of a step. Default: the ground.
struct RigidMotion {
    Vec3 center = Vec3::Zero(), velocity = Vec3::Zero(), spin = Vec3::Zero();
    Eigen::Quaterniond turn{1.0, 0.0, 0.0, 0.0};
    Vec3 pull = Vec3::Zero();                           ///< of all but contacts [m/s^2]
    double yields = 0.0;                                ///< 1/m [1/kg]
    Eigen::Matrix3d turns_by = Eigen::Matrix3d::Zero(); ///< inverse inertia, world [1/(kg m^2)]

    RigidMotion() = default;
    /// @param body  null: the ground.
    explicit RigidMotion(dBodyID body);

    Vec3 velocity_at(const Vec3& point) const noexcept {
        return velocity + spin.cross(point - center);
    }
    /// Change of velocity along a unit direction per impulse along it there [1/kg].
    double yielding(const Vec3& point, const Vec3& along) const noexcept {
        const Vec3 arm = (point - center).cross(along);
        return yields + arm.dot(turns_by * arm);
    }
    /// Change of velocity and spin by an impulse at a place, all in the body's frame.
    Eigen::Matrix<double, 6, 1> jerk(const Vec3& place, const Vec3& impulse) const noexcept {
        const Eigen::Matrix3d r = turn.toRotationMatrix();
        Eigen::Matrix<double, 6, 1> out;
        out << yields * impulse, r.transpose() * (turns_by * (r * place.cross(impulse)));
        return out;
    }
    Vec3 into_frame(const Vec3& direction) const noexcept { return turn.conjugate() * direction; }
    Vec3 place_in_frame(const Vec3& point) const noexcept { return into_frame(point - center); }
};

} // namespace ode::sound
