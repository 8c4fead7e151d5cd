#include "bridge/rigid_bodies.h"

#include "bridge/blow.h"
#include "strike/pulse.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

/// Slower than this no blow of a body without modes is heard to be [rad/s].
constexpr double kHearing = 2.0 * 3.14159 * 2000.0;

FramePose pose_of(dBodyID body, double time) {
    const dReal *x = dBodyGetPosition(body), *q = dBodyGetQuaternion(body);
    return {time, Vec3(x), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
}

/// Whether this contact is one of those that the body had lately; notes it.
Acquaintance meet_again(RigidBody& body, const void* partner, const Vec3& local, const Vec3& world,
                        double moved, double time, double step) {
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
        return Acquaintance::kNew;
    }
    const double since = time - found->seen;
    *found = {partner, local, world, time};
    constexpr double kSlack = 0.5; // steps, for rounding
    return since <= (1.0 + kSlack) * step              ? Acquaintance::kLasting
           : since <= (Blow::kFlutter + kSlack) * step ? Acquaintance::kParted
                                                       : Acquaintance::kNew;
}

} // namespace

RigidBodies::~RigidBodies() {
    for (const auto& own : body_) {
        dSoftRigidWatchDestroy(own->watch);
        own->body = nullptr;
    }
}

std::shared_ptr<RigidBody> RigidBodies::add(dBodyID body, std::shared_ptr<const RigidModel> model) {
    auto made = std::make_shared<RigidBody>();
    made->body = body;
    made->watch = dSoftRigidWatchCreate(body);
    made->push.assign(model->omega.size(), 0.0f);
    made->damping.assign(model->omega.size(), 0.0f);
    made->shape.fill(made->damping);
    made->model = std::move(model);
    made->known.reserve(32);
    body_.push_back(made);
    list();
    return made;
}

void RigidBodies::remove(RigidBody& body, Scene& scene) noexcept {
    scene.end_body(&body);
    scrapes_.forget(body);
    pushes_.forget(body);
    dSoftRigidWatchDestroy(body.watch);
    body.body = nullptr;
    std::erase_if(body_, [&](const auto& own) { return own.get() == &body; });
    list();
}

void RigidBodies::list() {
    order_.clear();
    for (std::size_t i = 0; i < body_.size(); ++i)
        order_.emplace_back(body_[i]->body, i);
    std::sort(order_.begin(), order_.end());
}

RigidBody* RigidBodies::find(dBodyID body) const noexcept {
    const auto at = std::lower_bound(order_.begin(), order_.end(), std::pair(body, std::size_t{}));
    return at != order_.end() && at->first == body ? body_[at->second].get() : nullptr;
}

void RigidBodies::begin_step(dSoftWorldID world, double time, Scene& scene) {
    begin_ = time;
    for (std::size_t i = body_.size(); i-- > 0;)
        if (dSoftRigidWatchIsGone(body_[i]->watch))
            remove(*body_[i], scene);
    touches_.begin_step();
    for (std::size_t i = 0; i < body_.size(); ++i) {
        RigidBody& own = *body_[i];
        own.before = pose_of(own.body, time);
        touches_.gather(world, own.body, [&](dBodyID other) {
            const auto at =
                std::lower_bound(order_.begin(), order_.end(), std::pair(other, std::size_t{}));
            return at != order_.end() && at->first == other && at->second < i;
        });
    }
}

StruckVoice& RigidBodies::voice(const RigidBody& body, Scene& scene, RigidModels& models) const {
    if (StruckVoice* found = scene.find_struck(&body, body.place_in_scene))
        return *found;
    return scene.add_struck(&body, models.voice(body.model, scene.settings()));
}

void RigidBodies::feel(const dSoftRigidPushes& pushes, Scene& scene, RigidModels& models) {
    pushes_.feel(
        pushes, [this](dBodyID body) { return find(body); },
        [&](RigidBody& own) -> StruckVoice& { return voice(own, scene, models); });
}

void RigidBodies::strike(RigidBody& body, const Vec3& point, const Vec3& impulse, double contact,
                         double time, Scene& scene, RigidModels& models) const {
    const RigidMotion motion(body.body);
    const StruckSurface& surface = body.model->surface;
    const Vec3 along = motion.into_frame(impulse);
    std::fill(body.push.begin(), body.push.end(), 0.0f);
    const auto place = surface.nearest(motion.place_in_frame(point), -along);
    surface.project(place, along, body.push);
    voice(body, scene, models).strike(time, contact, body.push, motion.jerk(place.point, along));
}

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
    const Acquaintance acquaintance =
        meet_again(own, partner, touch.motion[mine].place_in_frame(touch.position), touch.position,
                   moved, begin_, std::max(before_, h));
    const std::optional<Blow> blow = find_blow(touch, acquaintance, begin_, h, before_);
    if (!blow) {
        // What chatters neither holds nor slides for long.
        if (acquaintance == Acquaintance::kLasting && touch.impulse.dot(touch.normal) > 0.0)
            bear(touch, side, partner, touch.impulse.dot(touch.normal) / h, scene, models);
        return;
    }
    const ContactPatch patch = patch_of(touch, side, geoms_);
    const double pressed = contact_time(blow->mass, patch.curvature, patch.modulus, blow->speed);
    const double duration = blow->goes_on ? std::max(pressed, 2.0 * h) : pressed;
    // What takes longer than a body's slowest wave bends it and doesn't ring it.
    bool any = false;
    for (int i = 0; i < 2; ++i) {
        if (!side[i])
            continue;
        constexpr double kHeard = 0.01;
        const std::vector<double>& omega = side[i]->model->omega;
        const double slowest = omega.empty() ? kHearing : std::min(omega.front(), kHearing);
        any = any || pulse_spectrum(slowest * duration) > kHeard;
    }
    if (!any)
        return;
    if (stroke_.given > 0.0 &&
        (stroke_.side[0] != side[0] || stroke_.side[1] != side[1] || stroke_.partner != partner ||
         std::fabs(stroke_.time - blow->time) > std::max(Stroke::kAtOnce, duration)))
        deal(scene, models);
    Stroke& stroke = stroke_;
    stroke.partner = partner;
    const double impulse = blow->impulse.norm();
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
        const Vec3 along = motion.into_frame(i == 0 ? blow->impulse : Vec3(-blow->impulse));
        side[i]->model->surface.project(patch.place[i], along, side[i]->push);
        stroke.jerk[i] += motion.jerk(motion.place_in_frame(touch.position), along);
    }
    stroke.given += impulse;
    stroke.time += part * (blow->time - stroke.time);
    stroke.duration += part * (duration - stroke.duration);
    stroke.energy += blow->energy;
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
                                 pulse_spectrum(side->model->omega[k] * stroke_.duration);
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

void RigidBodies::end_step(double time, Scene& scene, RigidModels& models) {
    const double h = time - begin_;
    touches_.read(h);
    pushes_.end_step(time, scene.settings().rate,
                     [&](RigidBody& own) -> StruckVoice& { return voice(own, scene, models); });
    for (const auto& own : body_) {
        own->bearings = 0;
        own->heard_soft = true;
        std::fill(own->damping.begin(), own->damping.end(), 0.0f);
    }
    for (const auto& own : body_)
        voice(*own, scene, models);
    for (RigidTouch& touch : touches_.all())
        meet(touch, h, scene, models);
    deal(scene, models);
    for (const auto& own : body_)
        std::erase_if(own->known, [&](const RigidBody::Known& known) {
            return begin_ - known.seen > (Blow::kFlutter + 1.0) * std::max(h, before_);
        });
    scene.advance_struck(
        [](const void* key) { return static_cast<const RigidBody*>(key)->before; });
    // From here on for the step that has just been made, which is heard after the next.
    scrapes_.end_step(begin_, time, scene.settings().rate, geoms_,
                      [&](RigidBody& own) -> StruckVoice& { return voice(own, scene, models); });
    for (const auto& own : body_) {
        if (own->bearings > 0 || own->damped)
            voice(*own, scene, models)
                .damp(own->bearings > 0 ? std::span<const float>(own->damping)
                                        : std::span<const float>());
        own->damped = own->bearings > 0;
    }
    before_ = h;
}

} // namespace ode::sound
