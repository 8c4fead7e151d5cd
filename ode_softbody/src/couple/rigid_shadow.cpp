#include "couple/rigid_shadow.h"

#include <cmath>

namespace ode::soft {
namespace {

// Explicit leapfrog with lagged damping is stable while dt^2 lambda + 2 dt c/m <= 4. A soft body at
// 0.9 of its critical step uses 3.24, its own side of the contacts 0.1 * 3.24 + 2 * 0.075 (see
// contact_law.h): 0.28 is left for friction on the rigid side. Normal springs need no share: their
// force is found together with the motion that it makes (RigidResponse).
constexpr double kRigidBudget = 0.28;

// A sleeping body wakes when what presses on it differs by more than this from what did when it
// fell asleep. Its rest shifts the load by the few per cent that it still moved.
constexpr double kRouse = 0.2;

Vec3 vec(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

} // namespace

RigidShadow::RigidShadow(dBodyID body, double h, double dt) noexcept
    : body_(body), h_(h), last_dt_(dt) {
    if (!body)
        return;
    free_ = FreeMotion(body);
    if (dBodyIsKinematic(body)) {
        role_ = RigidRole::prescribed;
        show_motion();
        motion_.velocity = vec(dBodyGetLinearVel(body)); // its mass may be anything
        motion_.spin = vec(dBodyGetAngularVel(body));
        return;
    }
    role_ = dBodyGetNumJoints(body) == 0 ? RigidRole::free : RigidRole::unheard;
    asleep_ = !dBodyIsEnabled(body);
    inverse_mass_ = free_.inverse_mass();
    if (dBodyGetGravityMode(body)) {
        dVector3 g;
        dWorldGetGravity(dBodyGetWorld(body), g);
        external_.force = vec(g) / inverse_mass_;
    }
    external_.force += vec(dBodyGetForce(body));
    external_.torque = vec(dBodyGetTorque(body));
    if (!asleep_)
        free_.kick(external_, (h - dt) / 2);
    show_motion();
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
    if (!asleep_) {
        resumes_ = role_ == RigidRole::free && before.bore_ && TwinState(body_) == before.written_;
        if (resumes_) {
            free_ = before.free_;
            show_motion();
        }
        return;
    }
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
        free_ = before->free_;
    } else if (!asleep_ && !resumes_) {
        free_.kick(external_, -(h_ - last_dt_) / 2);
    }
    show_motion();
}

void RigidShadow::add(const Wrench& reaction) noexcept {
    contact_.force += reaction.force;
    contact_.torque += reaction.torque;
    touched_ = true;
    borne_ |= reaction.force.squaredNorm() != 0;
}

void RigidShadow::add_from_rigid(const Wrench& reaction) noexcept {
    contact_.force += reaction.force;
    contact_.torque += reaction.torque;
    from_rigid_.force += reaction.force;
    from_rigid_.torque += reaction.torque;
    borne_ = true;
}

Vec6 RigidShadow::twist_ahead(double dt) const noexcept {
    Vec6 twist;
    twist << motion_.velocity, motion_.spin;
    if (inverse_mass_ == 0)
        return twist;
    if (twin_)
        return twist + dt * (twin_->drift + answer(contact_));
    twist.head<3>() += dt * inverse_mass_ * (external_.force + contact_.force);
    twist.tail<3>() += dt * (free_.inverse_inertia() * (external_.torque + contact_.torque));
    return twist;
}

Vec3 RigidShadow::velocity_ahead(const Vec3& world, double dt) const noexcept {
    const Vec6 twist = twist_ahead(dt);
    const Vec3 lever = world - motion_.pose.position;
    return twist.head<3>() + twist.tail<3>().cross(lever);
}

Mat6 RigidShadow::mobility() const noexcept {
    Mat6 out = Mat6::Zero();
    if (inverse_mass_ == 0)
        return out;
    if (twin_) {
        twin_->asked = true;
        const Mat3& r = motion_.pose.rotation;
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 2; ++k)
                out.block<3, 3>(3 * i, 3 * k) =
                    r * twin_->mobility.block<3, 3>(3 * i, 3 * k) * r.transpose();
        return out;
    }
    out.topLeftCorner<3, 3>() = inverse_mass_ * Mat3::Identity();
    out.bottomRightCorner<3, 3>() = free_.inverse_inertia();
    return out;
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
    return inverse_mass_ + lever.dot(free_.inverse_inertia() * lever);
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

double RigidShadow::grip_compliance(const Vec3& point, const Vec3& normal) const noexcept {
    if (inverse_mass_ == 0)
        return 0;
    // The larger eigenvalue of the compliance in the tangent plane.
    const Vec3 first = normal.unitOrthogonal();
    const Vec3 second = normal.cross(first);
    const double a = compliance(point, first);
    const double b = compliance(point, second);
    const double both = compliance(point, (first + second) * M_SQRT1_2);
    return (a + b) / 2 + std::hypot((a - b) / 2, both - (a + b) / 2);
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
            free_.kick(external_, (h_ - dt) / 2);
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
    free_.kick({external_.force + contact_.force, external_.torque + contact_.torque}, dt);
    free_.drift(dt);
    show_motion();
    end_substep();
    last_dt_ = dt;
}

void RigidShadow::show_motion() noexcept {
    orientation_ = free_.orientation();
    motion_ = {free_.pose(), free_.velocity(), free_.spin()};
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
    const FreeMotion inner = free_;
    if (!bore_)
        free_.kick(external_, -(h_ - last_dt_) / 2);
    show_motion();
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
    if (!propped_ && !bore_)
        return;
    written_ = TwinState(body_);
    free_ = inner;
    free_.scale(keep, keep_spin);
}

} // namespace ode::soft
