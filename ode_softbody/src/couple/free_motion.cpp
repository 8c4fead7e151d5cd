#include "couple/free_motion.h"

#include <cmath>

namespace ode::soft {
namespace {

Vec3 vec(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

} // namespace

Quat turned(const Quat& from, const Vec3& rotation) noexcept {
    const double half = rotation.norm() / 2;
    // sin(half)/half to second order is exact in double below 1e-4
    const double sinc = half > 1e-4 ? std::sin(half) / half : 1 - half * half / 6;
    const Vec3 axis = sinc / 2 * rotation;
    return Quat(std::cos(half), axis.x(), axis.y(), axis.z()) * from;
}

FreeMotion::FreeMotion(dBodyID body) noexcept {
    const dReal* q = dBodyGetQuaternion(body);
    orientation_ = Quat(q[0], q[1], q[2], q[3]);
    pose_.position = vec(dBodyGetPosition(body));
    gyroscopic_ = dBodyGetGyroscopicMode(body);
    max_spin_ = dBodyGetMaxAngularSpeed(body);
    dMass mass;
    dBodyGetMass(body, &mass);
    inverse_mass_ = 1 / mass.mass;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            inertia_(i, j) = mass.I[4 * i + j];
    inverse_inertia_ = inertia_.inverse();
    const Mat3 r = orientation_.toRotationMatrix();
    momentum_ = mass.mass * vec(dBodyGetLinearVel(body));
    angular_momentum_ = r * (inertia_ * (r.transpose() * vec(dBodyGetAngularVel(body))));
    update_frame();
}

void FreeMotion::kick(const Wrench& push, double dt) noexcept {
    momentum_ += dt * push.force;
    angular_momentum_ += dt * push.torque;
    update_velocities();
}

Vec3 FreeMotion::spin_of(const Quat& orientation) const noexcept {
    const Mat3 r = orientation.toRotationMatrix();
    return r * (inverse_inertia_ * (r.transpose() * angular_momentum_));
}

void FreeMotion::drift(double dt) noexcept {
    pose_.position += dt * inverse_mass_ * momentum_;
    Vec3 spin = spin_of(orientation_);
    const double speed = spin.norm();
    if (speed > max_spin_) { // as dBodySetMaxAngularSpeed
        spin *= max_spin_ / speed;
        angular_momentum_ *= max_spin_ / speed;
    }
    if (gyroscopic_) {
        const Vec3 midpoint = spin_of(turned(orientation_, dt / 2 * spin));
        orientation_ = turned(orientation_, dt * midpoint).normalized();
    } else { // it is the spin that stays, as under ODE
        orientation_ = turned(orientation_, dt * spin).normalized();
        const Mat3 r = orientation_.toRotationMatrix();
        angular_momentum_ = r * (inertia_ * (r.transpose() * spin));
    }
    update_frame();
}

void FreeMotion::scale(double linear, double angular) noexcept {
    momentum_ *= linear;
    angular_momentum_ *= angular;
    update_velocities();
}

void FreeMotion::update_frame() noexcept {
    pose_.rotation = orientation_.toRotationMatrix();
    inverse_inertia_world_ = pose_.rotation * inverse_inertia_ * pose_.rotation.transpose();
    update_velocities();
}

void FreeMotion::update_velocities() noexcept {
    velocity_ = inverse_mass_ * momentum_;
    spin_ = inverse_inertia_world_ * angular_momentum_;
}

} // namespace ode::soft
