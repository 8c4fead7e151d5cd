#pragma once

#include "collide/rigid_pose.h"

#include <ode/objects.h>

namespace ode::soft {

/// A free rigid body under leapfrog. State: centre, linear momentum, orientation and angular
/// momentum in the world frame; the latter holds the gyroscopic term by itself. Orientation by the
/// exponential of the midpoint spin.
class FreeMotion {
public:
    FreeMotion() = default;                     ///< can't be moved
    explicit FreeMotion(dBodyID body) noexcept; ///< as it is now

    const Pose& pose() const noexcept { return pose_; }
    const Quat& orientation() const noexcept { return orientation_; }
    const Vec3& velocity() const noexcept { return velocity_; }
    const Vec3& spin() const noexcept { return spin_; }
    double inverse_mass() const noexcept { return inverse_mass_; }
    const Mat3& inverse_inertia() const noexcept { return inverse_inertia_world_; } ///< world frame

    /// Velocities are of the new momenta at once.
    void kick(const Wrench& push, double dt) noexcept;
    void drift(double dt) noexcept;
    /// Both velocities, times these.
    void scale(double linear, double angular) noexcept;

private:
    void update_velocities() noexcept;
    void update_frame() noexcept;
    Vec3 spin_of(const Quat& orientation) const noexcept;

    Pose pose_;
    Quat orientation_ = Quat::Identity();
    Vec3 velocity_ = Vec3::Zero();         ///< of the centre [m/s]
    Vec3 spin_ = Vec3::Zero();             ///< world frame [rad/s]
    Vec3 momentum_ = Vec3::Zero();         ///< [kg m/s]
    Vec3 angular_momentum_ = Vec3::Zero(); ///< about the centre, world frame [kg m^2/s]
    double inverse_mass_ = 0;
    Mat3 inertia_ = Mat3::Identity();     ///< body frame [kg m^2]
    Mat3 inverse_inertia_ = Mat3::Zero(); ///< body frame
    Mat3 inverse_inertia_world_ = Mat3::Zero();
    double max_spin_ = 0; ///< [rad/s]
    bool gyroscopic_ = true;
};

/// Turns by `rotation` [rad] about its direction, in the world's frame.
Quat turned(const Quat& from, const Vec3& rotation) noexcept;

} // namespace ode::soft
