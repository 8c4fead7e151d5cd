#pragma once

#include "base/types.h"

namespace ode::soft {

/// Where a rigid frame is: x_world = position + rotation * x_local.
struct Pose {
    Vec3 position = Vec3::Zero(); ///< [m]
    Mat3 rotation = Mat3::Identity();

    Vec3 to_world(const Vec3& local) const noexcept { return position + rotation * local; }
    Vec3 to_local(const Vec3& world) const noexcept {
        return rotation.transpose() * (world - position);
    }
    /// This frame, given in `outer`, seen from where `outer` is given.
    Pose in(const Pose& outer) const noexcept {
        return {outer.to_world(position), outer.rotation * rotation};
    }
};

/// A rigid body's frame and motion at one moment. ODE puts a body's origin at its centre of mass.
struct RigidMotion {
    Pose pose;
    Vec3 velocity = Vec3::Zero(); ///< of the centre of mass [m/s]
    Vec3 spin = Vec3::Zero();     ///< world frame [rad/s]

    Vec3 velocity_at(const Vec3& world) const noexcept {
        return velocity + spin.cross(world - pose.position);
    }
};

/// Force and torque on a rigid body, world frame, torque about its centre of mass.
struct Wrench {
    Vec3 force = Vec3::Zero();  ///< [N]
    Vec3 torque = Vec3::Zero(); ///< [N m]
};

} // namespace ode::soft
