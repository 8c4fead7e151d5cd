// From contact joints to blows, to what bears and what slides.
#include "bridge/rigid_bodies.h"
#include "strike/pulse.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

/// Slower than this no blow of a body without modes is heard to be [rad/s].
constexpr double kHearing = 2.0 * 3.14159 * 2000.0;

/// How this contact has been lately; notes it. @param load  in this step [N].
History meet_again(RigidBody& body, const void* partner, const Vec3& local, const Vec3& world,
                   double moved, double time, double step, double load) {
    const double radius = body.model->surface.radius();
    const double near = std::max(5e-3, 0.25 * radius);
    RigidBody::Known* found = nullptr;
    for (RigidBody::Known& own : body.known)
        if (own.partner == partner && own.seen < time &&
            ((own.local - local).norm() < near || (own.world - world).norm() < near + moved)) {
            if (!found || own.seen > found->seen)
                found = &own;
        }
    if (!found) {
        body.known.push_back({partner, local, world, time});
        return {};
    }
    History out{Acquaintance::kNew, found->load, found->steps};
    const double since = time - found->seen;
    constexpr double kSlack = 0.5; // steps, for rounding
    out.acquaintance = since <= (1.0 + kSlack) * step              ? Acquaintance::kLasting
                       : since <= (Blow::kFlutter + kSlack) * step ? Acquaintance::kParted
                                                                   : Acquaintance::kNew;
    const bool lasts = out.acquaintance == Acquaintance::kLasting;
    constexpr double kLearns = 0.25; // the mean of some four steps
    *found = {partner,
              local,
              world,
              time,
              found->load + kLearns * (load - found->load),
              lasts ? found->steps + 1 : 0};
    return out;
}

} // namespace

bool RigidBodies::locate(RigidTouch& touch) const noexcept {
    if (touch.located)
        return true;
    // The line of force, from force and torque; a contact gives no torque about itself.
    const bool first = find(touch.body[0]) != nullptr;
    const RigidBody* body = first ? find(touch.body[0]) : find(touch.body[1]);
    const RigidMotion& motion = touch.motion[first ? 0 : 1];
    const Vec3 force = first ? touch.impulse : Vec3(-touch.impulse);
    const double square = force.squaredNorm();
    if (!body || !(square > 0.0))
        return false;
    const Vec3 arm = force.cross(first ? touch.turning : touch.second_turning) / square;
    // The overlap that the line passes: how deep it is tells when they met, its geom what of.
    const RecalledContact* best = nullptr;
    double least = HUGE_VAL;
    const Vec3 along = force.normalized();
    for (const RecalledContact& own : touches_.recalled(touch)) {
        const Vec3 off = own.position - (motion.center + arm);
        const double distance = (off - off.dot(along) * along).norm();
        if (distance < least && own.normal.dot(touch.impulse) > 0.0) {
            least = distance;
            best = &own;
        }
    }
    if (best) {
        touch.position = best->position;
        touch.normal = best->normal;
        touch.depth = best->depth;
        for (int i = 0; i < 2; ++i)
            touch.geom[i] = best->geom[i];
        return true;
    }
    const auto place =
        body->model->surface.entered(motion.into_frame(arm), motion.into_frame(force));
    touch.position = motion.center + motion.turn * place.point;
    touch.normal = touch.impulse.normalized();
    touch.depth = 0.0;
    return true;
}

void RigidBodies::meet(RigidTouch& touch, double h, Scene& scene, RigidModels& models) {
    if (!locate(touch))
        return;
    if (touch.impulse.dot(touch.normal) < 0.0)
        touch.normal = -touch.normal;
    RigidBody* side[2] = {find(touch.body[0]), touch.body[1] ? find(touch.body[1]) : nullptr};
    RigidBody& own = *(side[0] ? side[0] : side[1]);
    const int mine = side[0] ? 0 : 1;
    const void* partner = touch.geom[1 - mine] ? static_cast<const void*>(touch.geom[1 - mine])
                                               : touch.body[1 - mine];
    const double moved = h * (touch.motion[mine].velocity_at(touch.position).norm());
    const double load = touch.impulse.dot(touch.normal) / h;
    const History history =
        meet_again(own, partner, touch.motion[mine].place_in_frame(touch.position), touch.position,
                   moved, begin_, std::max(before_, h), load);
    const std::optional<Blow> blow = find_blow(touch, history, begin_, h, before_);
    if (blow && blow->passed) {
        passed_.push_back({&touch, {side[0], side[1]}, partner, *blow});
    } else if (blow) {
        fell_.push_back({{touch.body[0], touch.body[1]}, blow->time});
        fall(touch, side, partner, *blow, h, scene, models);
    } else if (history.acquaintance == Acquaintance::kLasting && load > 0.0) {
        // What chatters neither holds nor slides for long.
        bear(touch, side, partner, load, scene, models);
    }
}

void RigidBodies::fall_passed(double h, Scene& scene, RigidModels& models) {
    // From body to body, at the time of the blow that set it off.
    for (bool more = true; more;) {
        more = false;
        for (Passed& own : passed_) {
            if (!own.touch)
                continue;
            const auto cause = std::find_if(fell_.begin(), fell_.end(), [&](const Fell& blow) {
                for (const dBodyID a : blow.body)
                    for (const dBodyID b : own.touch->body)
                        if (a && a == b)
                            return true;
                return false;
            });
            if (cause == fell_.end())
                continue;
            own.blow.time = cause->time;
            fell_.push_back({{own.touch->body[0], own.touch->body[1]}, own.blow.time});
            fall(*own.touch, own.side, own.partner, own.blow, h, scene, models);
            own.touch = nullptr;
            more = true;
        }
    }
    for (Passed& own : passed_) // by what has no voice, or by the application
        if (own.touch)
            fall(*own.touch, own.side, own.partner, own.blow, h, scene, models);
    passed_.clear();
    fell_.clear();
}

void RigidBodies::fall(const RigidTouch& touch, RigidBody* const side[2], const void* partner,
                       const Blow& blow, double h, Scene& scene, RigidModels& models) {
    const ContactPatch patch = patch_of(touch, side, geoms_);
    const double pressed = contact_time(blow.mass, patch.curvature, patch.modulus, blow.speed);
    const double duration = blow.goes_on ? std::max(pressed, 2.0 * h) : pressed;
    // What takes longer than a body's slowest wave bends it and doesn't ring it.
    bool any = false;
    for (int i = 0; i < 2; ++i) {
        if (!side[i])
            continue;
        constexpr double kHeard = 0.01;
        const std::vector<double>& omega = side[i]->model->omega;
        const double slowest = omega.empty() ? kHearing : std::min(omega.front(), kHearing);
        any = any || std::fabs(pulse_spectrum(slowest * duration).value) > kHeard;
    }
    if (!any)
        return;
    if (stroke_.given > 0.0 &&
        (stroke_.side[0] != side[0] || stroke_.side[1] != side[1] || stroke_.partner != partner ||
         std::fabs(stroke_.time - blow.time) > std::max(Stroke::kAtOnce, duration)))
        deal(scene, models);
    Stroke& stroke = stroke_;
    stroke.partner = partner;
    const double impulse = blow.impulse.norm();
    const double part = impulse / (stroke.given + impulse);
    for (int i = 0; i < 2; ++i) {
        stroke.side[i] = side[i];
        if (!side[i])
            continue;
        if (stroke.given == 0.0) {
            std::fill(side[i]->push.begin(), side[i]->push.end(), 0.0f);
            stroke.jerk[i].setZero();
        }
        ++side[i]->blows;
        const RigidMotion& motion = touch.motion[i];
        const Vec3 along = motion.into_frame(i == 0 ? blow.impulse : Vec3(-blow.impulse));
        side[i]->model->surface.project(patch.place[i], along, side[i]->push);
        stroke.jerk[i] += motion.jerk(motion.place_in_frame(touch.position), along);
    }
    stroke.given += impulse;
    stroke.time += part * (blow.time - stroke.time);
    stroke.duration += part * (duration - stroke.duration);
    stroke.energy += blow.energy;
}

void RigidBodies::bear(const RigidTouch& touch, RigidBody* const side[2], const void* partner,
                       double load, Scene& scene, RigidModels& models) {
    scrapes_.bear(touch, side, partner, load);
    bool rings = false;
    for (int i = 0; i < 2; ++i)
        rings = rings || (side[i] && side[i]->bearings < RigidBody::kMostBearings &&
                          !voice(*side[i], scene, models).is_silent());
    if (!rings)
        return;
    const ContactPatch patch = patch_of(touch, side, geoms_);
    const double stiffness = bearing_stiffness(load, patch.curvature, patch.modulus);
    for (int i = 0; i < 2; ++i) {
        if (!side[i] || side[i]->bearings == RigidBody::kMostBearings)
            continue;
        ++side[i]->bearings;
        const RigidModel& model = *side[i]->model;
        // Along the normal, and along the surface where friction holds (Mindlin: less stiff).
        const Vec3 n = touch.motion[i].into_frame(touch.normal), u = n.unitOrthogonal();
        const double nu = model.elastic.poisson;
        const double along = touch.friction == 0.0 ? 0.0 : 2.0 * (1.0 - nu) / (2.0 - nu);
        const std::pair<Vec3, double> way[] = {{n, 1.0}, {u, along}, {n.cross(u), along}};
        float held[3];
        for (std::size_t w = 0; w < 3; ++w) {
            held[w] = static_cast<float>(way[w].second * stiffness);
            std::fill(side[i]->shape[w].begin(), side[i]->shape[w].end(), 0.0f);
            if (way[w].second > 0.0)
                model.surface.project(patch.place[i], way[w].first, side[i]->shape[w]);
        }
        const auto half_loss = static_cast<float>(0.5 * patch.loss);
        const float *a = side[i]->shape[0].data(), *b = side[i]->shape[1].data(),
                    *c = side[i]->shape[2].data(), *omega = model.omega_floats.data();
        float* const damping = side[i]->damping.data();
        for (std::size_t k = 0; k < model.omega.size(); ++k) {
            const float w = omega[k], square = w * w;
            const float x = held[0] * a[k] * a[k], y = held[1] * b[k] * b[k],
                        z = held[2] * c[k] * c[k];
            damping[k] += half_loss * w * (x / (square + x) + y / (square + y) + z / (square + z));
        }
    }
}

void RigidBodies::deal(Scene& scene, RigidModels& models) {
    if (!(stroke_.given > 0.0))
        return;
    double taken = 0.0; // by the modes of both [J]
    for (const RigidBody* side : stroke_.side)
        for (std::size_t k = 0; side && k < side->push.size(); ++k) {
            const double speed = static_cast<double>(side->push[k]) *
                                 pulse_spectrum(side->model->omega[k] * stroke_.duration).value;
            taken += 0.5 * speed * speed;
        }
    const double share = taken > stroke_.energy ? std::sqrt(stroke_.energy / taken) : 1.0;
    for (int i = 0; i < 2; ++i) {
        RigidBody* const side = stroke_.side[i];
        if (!side)
            continue;
        for (float& push : side->push)
            push *= static_cast<float>(share);
        voice(*side, scene, models)
            .strike(stroke_.time, stroke_.duration, side->push, stroke_.jerk[i]);
    }
    stroke_ = {};
}

} // namespace ode::sound
