#include "bridge/soft_pushes.h"

#include "bridge/rigid_bodies.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace ode::sound {

SoftPushes::Pair& SoftPushes::pair_of(RigidBody& rigid, dSoftBodyID soft) {
    const auto found = std::find_if(pair_.begin(), pair_.end(), [&](const Pair& own) {
        return own.rigid == &rigid && own.soft == soft;
    });
    if (found != pair_.end())
        return *found;
    Pair& made = pair_.emplace_back();
    made.rigid = &rigid;
    made.soft = soft;
    made.now.assign(rigid.model->omega.size(), 0.0f);
    made.mean.assign(made.now.size(), 0.0);
    made.rest = made.mean;
    const bool moved = !dBodyIsKinematic(rigid.body);
    dMass mass;
    dBodyGetMass(rigid.body, &mass);
    made.yields = moved ? 1.0 / mass.mass : 0.0;
    Eigen::Matrix3d inertia;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            inertia(i, j) = mass.I[4 * i + j];
    made.turns_by = moved ? Eigen::Matrix3d(inertia.inverse()) : Eigen::Matrix3d::Zero();
    return made;
}

void SoftPushes::add(Pair& pair, const dSoftRigidPush& push) {
    Eigen::Matrix3d turn;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            turn(i, j) = push.rotation[4 * i + j];
    const Vec3 at = turn.transpose() * (Vec3(push.position) - Vec3(push.center));
    const Vec3 force = turn.transpose() * Vec3(push.force);
    const StruckSurface& surface = pair.rigid->model->surface;
    if (pair.spots == pair.spot.size())
        pair.spot.push_back({Vec3::Constant(HUGE_VAL), {}});
    Spot& spot = pair.spot[pair.spots++];
    // From substep to substep it is the same place: modes do not vary over so little.
    const double near = 2e-3 * surface.radius();
    if (!((at - spot.looked).squaredNorm() < near * near))
        spot = {at, surface.nearest(at, -force)};
    surface.project(spot.place, force, pair.now);
    pair.jerk.head<3>() += pair.yields * force;
    pair.jerk.tail<3>() += pair.turns_by * at.cross(force);
}

void SoftPushes::feel(const dSoftRigidPushes& pushes, const Find& find, const Voice& voice) {
    for (int i = 0; i < pushes.count; ++i) {
        const dSoftRigidPush& push = pushes.push[i];
        RigidBody* const rigid = find(push.body);
        if (!rigid)
            continue;
        const std::size_t known = pair_.size();
        Pair& pair = pair_of(*rigid, push.soft);
        if (pair_.size() > known)
            pair.seen = pushes.time - pushes.dt;
        if (!pair.pressed) {
            pair.pressed = true;
            pair.spots = 0;
            pair.jerk.setZero();
            std::fill(pair.now.begin(), pair.now.end(), 0.0f);
        }
        add(pair, push);
    }
    for (Pair& pair : pair_) {
        if (!pair.pressed)
            continue;
        pair.pressed = false;
        const double begin = pushes.time - pushes.dt;
        if (pair.seen + 0.5 * pushes.dt < begin)
            relax(pair, begin, rate_, voice);
        tell(pair, pushes.time, pushes.dt, voice);
    }
}

void SoftPushes::tell(Pair& pair, double time, double dt, const Voice& voice) {
    // What lay on it when its voice was made, or when nobody listened, is no news.
    if (!pair.rigid->heard_soft) {
        pair.mean.assign(pair.now.begin(), pair.now.end());
        pair.mean_jerk = pair.jerk;
    }
    const double learn = -std::expm1(-dt / kSteady);
    double square = 0.0;
    for (std::size_t k = 0; k < pair.now.size(); ++k) {
        const double now = static_cast<double>(pair.now[k]), off = now - pair.mean[k];
        square += now * now;
        pair.rest[k] = dt * off;
        pair.mean[k] += learn * off;
    }
    const RigidSound::Six jerk = pair.jerk - pair.mean_jerk;
    pair.mean_jerk += learn * jerk;
    pair.most = std::max(pair.most, square);
    pair.seen = time;
    voice(*pair.rigid).push(time - 0.5 * dt, pair.rest, dt * jerk);
}

bool SoftPushes::is_quiet(const Pair& pair) const noexcept {
    constexpr double kLittle = 1e-9; // 90 dB
    double square = 0.0;
    for (const double mean : pair.mean)
        square += mean * mean;
    return square <= kLittle * pair.most && pair.mean_jerk.squaredNorm() < 1e-6;
}

void SoftPushes::relax(Pair& pair, double time, double rate, const Voice& voice) {
    std::fill(pair.now.begin(), pair.now.end(), 0.0f);
    pair.jerk.setZero();
    // By the sample: a course this slow needs no more.
    while (pair.seen < time && !is_quiet(pair)) {
        const double next = std::min(time, pair.seen + 1.0 / rate);
        tell(pair, next, next - pair.seen, voice);
    }
    pair.seen = time;
}

void SoftPushes::end_step(double time, double rate, const Voice& voice) {
    rate_ = rate;
    for (Pair& pair : pair_) {
        if (!dSoftBodyIsEnabled(pair.soft))
            pair.seen = time; // presses as it did
        else if (pair.seen < time - 0.5 / rate)
            relax(pair, time, rate, voice);
    }
    std::erase_if(pair_, [&](const Pair& own) {
        return is_quiet(own) && dSoftBodyIsEnabled(own.soft) && own.spots == 0;
    });
    for (Pair& pair : pair_)
        pair.spots = 0;
}

void SoftPushes::forget(const RigidBody& body) noexcept {
    std::erase_if(pair_, [&](const Pair& own) { return own.rigid == &body; });
}

void SoftPushes::forget(dSoftBodyID soft) noexcept {
    std::erase_if(pair_, [&](const Pair& own) { return own.soft == soft; });
}

} // namespace ode::sound
