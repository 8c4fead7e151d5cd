#include "bridge/rigid_bodies.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

FramePose pose_of(dBodyID body, double time) {
    const dReal *x = dBodyGetPosition(body), *q = dBodyGetQuaternion(body);
    return {time, Vec3(x), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
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
    fall_passed(h, scene, models);
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
