// How the twins move: their substeps, the accelerations and mobilities asked of ODE by steps on
// trial.
#include "couple/mirror_world.h"

#include <dlfcn.h>

#include <algorithm>

namespace ode::soft {
namespace {

Mat3 rotation_of(dBodyID body) noexcept {
    const dReal* r = dBodyGetRotation(body);
    Mat3 m;
    m << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
    return m;
}

/// Both halves of a 6-vector turned.
Vec6 turned(const Mat3& r, const Vec6& v) noexcept {
    Vec6 out;
    out << r * v.head<3>(), r * v.tail<3>();
    return out;
}

} // namespace

int real_world_step(dWorldID world, dReal h) noexcept {
    using Step = int (*)(dWorldID, dReal);
    static const auto real = [] {
        const auto next = reinterpret_cast<Step>(dlsym(RTLD_NEXT, "dWorldStep"));
        return next ? next : &dWorldStep; // ODE comes before this library, or is part of it
    }();
    return real(world, h);
}

void MirrorWorld::save() noexcept {
    saved_.clear();
    for (const MirroredBody& body : body_)
        saved_.emplace_back(body.twin);
}

void MirrorWorld::restore() noexcept {
    for (std::size_t i = 0; i < body_.size(); ++i)
        saved_[i].apply(body_[i].twin);
}

void MirrorWorld::step(double dt) noexcept {
    for (const MirroredBody& body : body_) {
        if (!body.dynamic || !dBodyIsEnabled(body.twin))
            continue;
        const Vec3& f = body.external.force;
        const Vec3& t = body.external.torque;
        dBodyAddForce(body.twin, f.x(), f.y(), f.z());
        dBodyAddTorque(body.twin, t.x(), t.y(), t.z());
    }
    real_world_step(world_, dt);
    ++steps_;
}

void MirrorWorld::find_accelerations() noexcept {
    acceleration_.assign(body_.size(), Vec6::Zero());
    if (!is_awake())
        return;
    save();
    step(dt_); // takes what of the velocities the joints don't allow
    for (std::size_t i = 0; i < body_.size(); ++i)
        acceleration_[i] = -TwinState(body_[i].twin).twist();
    step(dt_);
    for (std::size_t i = 0; i < body_.size(); ++i)
        acceleration_[i] = (acceleration_[i] + TwinState(body_[i].twin).twist()) / dt_;
    restore();
}

void MirrorWorld::measure_mobility() noexcept {
    save();
    step(dt_);
    for (std::size_t i = 0; i < body_.size(); ++i)
        acceleration_[i] = TwinState(body_[i].twin).twist();
    for (std::size_t i = 0; i < body_.size(); ++i) {
        MirroredBody& body = body_[i];
        if (!body.asked || body.measured || !body.dynamic || !dBodyIsEnabled(body.twin))
            continue;
        const Mat3 r = rotation_of(body.twin);
        Mat6 mobility;
        for (int column = 0; column < 6; ++column) {
            restore();
            // Large enough to stand out of rounding, small enough for no motor to give way: an
            // unhindered body would get 1 mm/s or 1 mrad/s.
            const double size = 1e-3 / (dt_ * body.mobility(column, column));
            const Vec6 push = turned(r, size * Vec6::Unit(column));
            dBodyAddForce(body.twin, push[0], push[1], push[2]);
            dBodyAddTorque(body.twin, push[3], push[4], push[5]);
            step(dt_);
            mobility.col(column) =
                turned(r.transpose(), TwinState(body.twin).twist() - acceleration_[i]) /
                (dt_ * size);
        }
        body.mobility = (mobility + mobility.transpose()) / 2;
        body.measured = true;
    }
    restore();
    for (MirroredBody& body : body_)
        body.asked = false;
}

bool MirrorWorld::is_awake() const noexcept {
    return std::any_of(body_.begin(), body_.end(),
                       [](const MirroredBody& b) { return b.dynamic && dBodyIsEnabled(b.twin); });
}

void MirrorWorld::advance(double dt) noexcept {
    if (body_.empty())
        return;
    if (dt != dt_)
        scale(dt);
    if (std::any_of(body_.begin(), body_.end(),
                    [](const auto& b) { return b.asked && !b.measured && b.dynamic; }))
        measure_mobility();
    for (const MirroredBody& body : body_) {
        if (!body.touched)
            continue;
        dBodyEnable(body.twin);
        const Wrench& c = body.contact;
        dBodyAddForce(body.twin, c.force.x(), c.force.y(), c.force.z());
        dBodyAddTorque(body.twin, c.torque.x(), c.torque.y(), c.torque.z());
    }
    if (!is_awake())
        return;
    for (std::size_t i = 0; i < body_.size(); ++i)
        acceleration_[i] = TwinState(body_[i].twin).twist();
    std::vector<MirroredBody>& all = body_;
    const auto answer_of = [](const MirroredBody& body, const Mat3& r) {
        Vec6 wrench;
        wrench << body.contact.force, body.contact.torque;
        return turned(r, body.mobility * turned(r.transpose(), wrench));
    };
    for (MirroredBody& body : all)
        body.drift = -answer_of(body, rotation_of(body.twin));
    step(dt);
    for (std::size_t i = 0; i < body_.size(); ++i) {
        body_[i].drift += (TwinState(body_[i].twin).twist() - acceleration_[i]) / dt;
        body_[i].borne = body_[i].contact.force.squaredNorm() != 0;
        body_[i].contact = {};
    }
}

void MirrorWorld::spread_borne() noexcept {
    for (bool more = true; more;) {
        more = false;
        for (const Joint& joint : joint_) {
            MirroredBody* const first = joint.first ? find(joint.first) : nullptr;
            MirroredBody* const second = joint.second ? find(joint.second) : nullptr;
            if (!first || !second || first->borne == second->borne)
                continue;
            first->borne = second->borne = more = true;
        }
    }
}

void MirrorWorld::write_back() noexcept {
    if (std::none_of(body_.begin(), body_.end(), [](const auto& b) { return b.live; }))
        return;
    find_accelerations();
    spread_borne();
    for (std::size_t i = 0; i < body_.size(); ++i) {
        MirroredBody& body = body_[i];
        body.known = body.live && body.dynamic && dBodyIsEnabled(body.app);
        if (!body.known)
            continue;
        body.inner = TwinState(body.twin);
        TwinState out = body.inner;
        if (!body.propped && !body.borne)
            out.set_twist(out.twist() - (h_ - dt_) / 2 * acceleration_[i]);
        out.apply(body.app);
        body.written = TwinState(body.app);
    }
}

} // namespace ode::soft
