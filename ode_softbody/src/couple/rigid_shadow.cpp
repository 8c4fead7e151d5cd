#include "couple/rigid_shadow.h"

#include <cmath>

namespace ode::soft {
namespace {

// Explicit leapfrog with lagged damping is stable while dt^2 lambda + 2 dt c/m <= 4. A soft body at
// 0.9 of its critical step uses 3.24, its own side of the contacts 0.1 * 3.24 + 2 * 0.075 (see
// node_contact.cpp): 0.28 is left for the rigid side.
constexpr double kRigidBudget = 0.28;

// A sleeping body wakes when what presses on it differs by more than this from what did when it
// fell asleep. Its rest shifts the load by the few per cent that it still moved.
constexpr double kRouse = 0.2;

Vec3 vec(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

/// Turns by `rotation` [rad] about its direction, in the world's frame.
Quat turned(const Quat& from, const Vec3& rotation) noexcept {
    const double half = rotation.norm() / 2;
    // sin(half)/half to second order is exact in double below 1e-4
    const double sinc = half > 1e-4 ? std::sin(half) / half : 1 - half * half / 6;
    const Vec3 axis = sinc / 2 * rotation;
    return Quat(std::cos(half), axis.x(), axis.y(), axis.z()) * from;
}

} // namespace

RigidShadow::RigidShadow(dBodyID body, double h, double dt) noexcept
    : body_(body), h_(h), last_dt_(dt) {
    if (!body)
        return;
    const dReal* q = dBodyGetQuaternion(body);
    orientation_ = Quat(q[0], q[1], q[2], q[3]);
    motion_.pose.position = vec(dBodyGetPosition(body));
    motion_.velocity = vec(dBodyGetLinearVel(body));
    motion_.spin = vec(dBodyGetAngularVel(body));
    if (dBodyIsKinematic(body)) {
        role_ = RigidRole::prescribed;
        motion_.pose.rotation = orientation_.toRotationMatrix();
        return;
    }
    role_ = dBodyGetNumJoints(body) == 0 ? RigidRole::free : RigidRole::unheard;
    asleep_ = !dBodyIsEnabled(body);
    gyroscopic_ = dBodyGetGyroscopicMode(body);
    max_spin_ = dBodyGetMaxAngularSpeed(body);

    dMass mass;
    dBodyGetMass(body, &mass);
    inverse_mass_ = 1 / mass.mass;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            inertia_(i, j) = mass.I[4 * i + j];
    inverse_inertia_ = inertia_.inverse();
    if (dBodyGetGravityMode(body)) {
        dVector3 g;
        dWorldGetGravity(dBodyGetWorld(body), g);
        external_.force = mass.mass * vec(g);
    }
    external_.force += vec(dBodyGetForce(body));
    external_.torque = vec(dBodyGetTorque(body));

    const Mat3 r = orientation_.toRotationMatrix();
    momentum_ = mass.mass * motion_.velocity;
    angular_momentum_ = r * (inertia_ * (r.transpose() * motion_.spin));
    if (!asleep_)
        kick(external_.force, external_.torque, (h - dt) / 2);
    update_motion();
}

RigidShadow::RigidShadow(MirroredBody& twin, double h) noexcept
    : body_(twin.app), twin_(&twin), role_(RigidRole::mirrored), h_(h) {
    if (!twin.dynamic)
        role_ = RigidRole::prescribed;
    live_ = twin.live;
    asleep_ = twin.dynamic && !dBodyIsEnabled(body_);
    inverse_mass_ = twin.dynamic ? 1 : 0; // the mobility holds the true one
    follow();
}

void RigidShadow::remember(const RigidShadow& before) noexcept {
    linger_ = before.linger_;
    if (!asleep_)
        return;
    if (before.asleep_) {
        rest_ = before.rest_;
        has_rest_ = before.has_rest_;
    } else if (before.touched_) {
        rest_ = {before.impulse_.force / before.h_, before.impulse_.torque / before.h_};
        has_rest_ = true;
    }
}

bool RigidShadow::is_roused() const noexcept {
    const double least = kRouse * rest_.force.norm();
    return asleep_ && touched_ && !(has_rest_ && (contact_.force - rest_.force).norm() < least);
}

void RigidShadow::prop(const RigidShadow* before) noexcept {
    propped_ = true;
    if (role_ == RigidRole::unheard)
        role_ = RigidRole::free;
    if (role_ != RigidRole::free)
        return;
    live_ = before && before->live_;
    if (live_ && before->propped_ && TwinState(body_) == before->written_) {
        motion_.pose.position = before->motion_.pose.position;
        orientation_ = before->orientation_;
        momentum_ = before->momentum_;
        angular_momentum_ = before->angular_momentum_;
    } else if (!asleep_) {
        kick(external_.force, external_.torque, -(h_ - last_dt_) / 2);
    }
    update_motion();
}

void RigidShadow::add(const Wrench& reaction) noexcept {
    contact_.force += reaction.force;
    contact_.torque += reaction.torque;
    touched_ = true;
    borne_ = true;
}

void RigidShadow::add_from_rigid(const Wrench& reaction) noexcept {
    contact_.force += reaction.force;
    contact_.torque += reaction.torque;
    from_rigid_.force += reaction.force;
    from_rigid_.torque += reaction.torque;
    borne_ = true;
}

Vec3 RigidShadow::velocity_ahead(const Vec3& world, double dt) const noexcept {
    if (inverse_mass_ == 0)
        return motion_.velocity_at(world);
    const Vec3 lever = world - motion_.pose.position;
    if (twin_) {
        const Vec6 ahead = dt * (twin_->drift + answer(contact_));
        return motion_.velocity + ahead.head<3>() + (motion_.spin + ahead.tail<3>()).cross(lever);
    }
    const Vec3 force = external_.force + contact_.force;
    const Vec3 torque = external_.torque + contact_.torque;
    return motion_.velocity + dt * inverse_mass_ * force +
           (motion_.spin + dt * (inverse_inertia_world_ * torque)).cross(lever);
}

double RigidShadow::compliance(const Vec3& point, const Vec3& normal) const noexcept {
    if (inverse_mass_ == 0)
        return 0;
    const Vec3 lever = (point - motion_.pose.position).cross(normal);
    if (twin_) {
        twin_->asked = true;
        Vec6 push;
        push << motion_.pose.rotation.transpose() * normal,
            motion_.pose.rotation.transpose() * lever;
        return push.dot(twin_->mobility * push);
    }
    return inverse_mass_ + lever.dot(inverse_inertia_world_ * lever);
}

Vec6 RigidShadow::answer(const Wrench& contact) const noexcept {
    const Mat3& r = motion_.pose.rotation;
    Vec6 local;
    local << r.transpose() * contact.force, r.transpose() * contact.torque;
    const Vec6 turned = twin_->mobility * local;
    Vec6 world;
    world << r * turned.head<3>(), r * turned.tail<3>();
    return world;
}

double RigidShadow::soften(double load) noexcept {
    load_ += load;
    softening_ = std::fmin(softening_, kRigidBudget / load_);
    return softening_;
}

void RigidShadow::advance(double dt) noexcept {
    if (role_ == RigidRole::fixed)
        return;
    if (asleep_ && role_ != RigidRole::prescribed) {
        if (!is_roused()) {
            take_impulse(dt);
            end_substep();
            return;
        }
        asleep_ = false;
        if (role_ != RigidRole::mirrored && !propped_)
            kick(external_.force, external_.torque, (h_ - dt) / 2);
    }
    if (role_ == RigidRole::mirrored) {
        take_impulse(dt);
        twin_->contact = contact_;
        twin_->touched = twin_->touched || borne_;
        end_substep();
        return;
    }
    if (role_ == RigidRole::prescribed) {
        take_impulse(dt);
        contact_ = {};
        from_rigid_ = {};
        if (twin_)
            return; // moves in the mirror, at the same velocity
        motion_.pose.position += dt * motion_.velocity;
        orientation_ = turned(orientation_, dt * motion_.spin);
        motion_.pose.rotation = orientation_.toRotationMatrix();
        return;
    }
    take_impulse(dt);
    kick(external_.force + contact_.force, external_.torque + contact_.torque, dt);
    drift(dt);
    update_motion();
    end_substep();
    last_dt_ = dt;
}

void RigidShadow::take_impulse(double dt) noexcept {
    impulse_.force += dt * (contact_.force - from_rigid_.force);
    impulse_.torque += dt * (contact_.torque - from_rigid_.torque);
}

void RigidShadow::end_substep() noexcept {
    contact_ = {};
    from_rigid_ = {};
    if (load_ == 0)
        softening_ = 1;
    load_ = 0;
    bore_ = borne_;
    borne_ = false;
}

void RigidShadow::follow() noexcept {
    if (!twin_)
        return;
    const TwinState now(twin_->twin);
    orientation_ = Quat(now.quaternion[0], now.quaternion[1], now.quaternion[2], now.quaternion[3]);
    motion_.pose.position = vec(now.position.data());
    motion_.pose.rotation = orientation_.toRotationMatrix();
    motion_.velocity = vec(now.velocity.data());
    motion_.spin = vec(now.spin.data());
}

void RigidShadow::kick(const Vec3& force, const Vec3& torque, double dt) noexcept {
    momentum_ += dt * force;
    angular_momentum_ += dt * torque;
}

Vec3 RigidShadow::spin_of(const Quat& orientation) const noexcept {
    const Mat3 r = orientation.toRotationMatrix();
    return r * (inverse_inertia_ * (r.transpose() * angular_momentum_));
}

void RigidShadow::drift(double dt) noexcept {
    motion_.pose.position += dt * inverse_mass_ * momentum_;
    Vec3 spin = spin_of(orientation_);
    const double speed = spin.norm();
    if (speed > max_spin_) { // as dBodySetMaxAngularSpeed
        spin *= max_spin_ / speed;
        angular_momentum_ *= max_spin_ / speed;
    }
    if (gyroscopic_) {
        const Vec3 midpoint = spin_of(turned(orientation_, dt / 2 * spin));
        orientation_ = turned(orientation_, dt * midpoint).normalized();
        return;
    }
    // Without the gyroscopic term it is the spin that stays, as under ODE.
    orientation_ = turned(orientation_, dt * spin).normalized();
    const Mat3 r = orientation_.toRotationMatrix();
    angular_momentum_ = r * (inertia_ * (r.transpose() * spin));
}

void RigidShadow::update_motion() noexcept {
    const Mat3 r = orientation_.toRotationMatrix();
    inverse_inertia_world_ = r * inverse_inertia_ * r.transpose();
    motion_.pose.rotation = r;
    motion_.velocity = inverse_mass_ * momentum_;
    motion_.spin = inverse_inertia_world_ * angular_momentum_;
}

void RigidShadow::hand_over() noexcept {
    if (!touched_ || asleep_ || role_ == RigidRole::fixed || role_ == RigidRole::prescribed)
        return;
    // A sleeping body would hoard the force until it wakes; one that is awake would start to count
    // its idle steps anew.
    if (!dBodyIsEnabled(body_))
        dBodyEnable(body_);
    if (role_ != RigidRole::free || propped_) {
        const Vec3 f = impulse_.force / h_;
        const Vec3 t = impulse_.torque / h_;
        dBodyAddForce(body_, f.x(), f.y(), f.z());
        dBodyAddTorque(body_, t.x(), t.y(), t.z());
    }
}

void RigidShadow::write_back() noexcept {
    if (!(touched_ || live_) || asleep_ || role_ != RigidRole::free)
        return;
    // ODE damps once a step, after moving; its thresholds are speeds.
    const auto damped = [](const Vec3& v, double threshold, double scale) {
        return v.norm() > threshold ? 1 - scale : 1.0;
    };
    const Vec3 momentum = momentum_;
    const Vec3 angular_momentum = angular_momentum_;
    if (!(propped_ && bore_))
        kick(external_.force, external_.torque, -(h_ - last_dt_) / 2);
    update_motion();
    const double keep = damped(motion_.velocity, dBodyGetLinearDampingThreshold(body_),
                               dBodyGetLinearDamping(body_));
    const double keep_spin =
        damped(motion_.spin, dBodyGetAngularDampingThreshold(body_), dBodyGetAngularDamping(body_));
    const Vec3 v = keep * motion_.velocity;
    const Vec3 w = keep_spin * motion_.spin;
    const Vec3& x = motion_.pose.position;
    const dQuaternion q{orientation_.w(), orientation_.x(), orientation_.y(), orientation_.z()};
    dBodySetPosition(body_, x.x(), x.y(), x.z());
    dBodySetQuaternion(body_, q);
    dBodySetLinearVel(body_, v.x(), v.y(), v.z());
    dBodySetAngularVel(body_, w.x(), w.y(), w.z());
    if (!propped_)
        return;
    written_ = TwinState(body_);
    momentum_ = keep * momentum;
    angular_momentum_ = keep_spin * angular_momentum;
}

} // namespace ode::soft
