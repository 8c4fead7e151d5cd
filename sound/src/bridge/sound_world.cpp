#include "bridge/sound_world.h"

#include "bridge/kept_tables.h"
#include "mix/voice_model.h"

#include <ode/error.h>

#include <exception>
#include <stdexcept>
#include <type_traits>

namespace ode::sound {
namespace {

static_assert(std::is_same_v<dReal, double>,
              "the sound path reads ODE's numbers in place: build ODE in double precision");

Alarm::Fare fare_of(const void* body) {
    dSoftStatus status{};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(static_cast<dSoftBodyID>(const_cast<void*>(body)), &status);
    return {status.rollbacks, status.stopped != 0};
}

SoundWorld& self(void* data) noexcept { return *static_cast<SoundWorld*>(data); }

} // namespace

SoundWorld::SoundWorld(dSoftWorldID world) : world_(world) {}

SoundWorld::~SoundWorld() { end(); }

void SoundWorld::end() noexcept {
    ignore();
    on_world_end();
}

void SoundWorld::observe() {
    if (observing_ || !world_)
        return;
    dSoftObserver observer{};
    observer.struct_size = sizeof observer;
    observer.data = this;
    observer.on_substep = [](void* data, const dSoftSubstep* substep) {
        self(data).on_substep(*substep);
    };
    if (hears_modes(scene_.settings()))
        observer.on_modal = [](void* data, const dSoftModalState* state) {
            self(data).on_modal(*state);
        };
    if (!rigid_.empty())
        observer.on_rigid_pushes = [](void* data, const dSoftRigidPushes* pushes) {
            self(data).on_rigid_pushes(*pushes);
        };
    observer.on_step = [](void* data, dSoftWorldID, dReal time) { self(data).on_step(time); };
    observer.on_moved = [](void* data, dSoftWorldID, dReal time) { self(data).on_moved(time); };
    observer.on_body_end = [](void* data, dSoftBodyID body) { self(data).on_body_end(body); };
    observer.on_world_end = [](void* data, dSoftWorldID) { self(data).on_world_end(); };
    stepped_ = dSoftWorldGetTime(world_);
    observing_ = dSoftWorldAddObserver(world_, &observer) != 0;
}

void SoundWorld::set(const Settings& settings) {
    scene_.set(settings);
    voice_model_.clear();
    rigid_models_.forget_voices();
    if (!observing_)
        return;
    ignore(); // whether modes are wanted may have changed
    observe();
}

unsigned long SoundWorld::underruns() const noexcept {
    unsigned long sum = 0;
    for (const auto& listener : scene_.all())
        listener->for_each_sink([&](const Sink& sink) { sum += sink.underruns(); });
    return sum;
}

void SoundWorld::keep_pace() {
    if (world_)
        pace_.update(scene_, underruns(), stepped_);
}

void SoundWorld::ignore() noexcept {
    if (observing_ && world_)
        dSoftWorldRemoveObserver(world_, this);
    observing_ = false;
    rigid_.fall_silent();
}

Listener& SoundWorld::add_listener() {
    Listener& listener = scene_.add_listener(world_ ? dSoftWorldGetTime(world_) : 0.0);
    observe();
    return listener;
}

void SoundWorld::remove_listener(Listener& listener) noexcept {
    scene_.remove_listener(listener);
    if (scene_.listeners() == 0)
        ignore();
}

void SoundWorld::on_substep(const dSoftSubstep& substep) noexcept {
    if (failed_)
        return;
    try {
        SurfaceView view{substep.time, substep.dt, substep.position, substep.velocity,
                         substep.stride};
        constexpr int kPadded = 4;
        if (substep.stride < kPadded) {
            const auto nodes = static_cast<std::size_t>(substep.node_count);
            padded_.resize(2 * kPadded * nodes);
            for (std::size_t i = 0; i < nodes; ++i)
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t from = i * static_cast<std::size_t>(substep.stride) + k;
                    padded_[kPadded * i + k] = substep.position[from];
                    padded_[kPadded * (nodes + i) + k] = substep.velocity[from];
                }
            view.position = padded_.data();
            view.velocity = padded_.data() + kPadded * nodes;
            view.stride = kPadded;
        }
        const std::span<const int> triangle(substep.triangle,
                                            3 * static_cast<std::size_t>(substep.triangle_count));
        const auto push = [&] { scene_.push(substep.body, triangle, view); };
        if (!triangle.empty() && scene_.has_heard(substep.body))
            cost_.run(push);
        else if (!triangle.empty())
            cost_.run_whole(push); // what is worked out once a body
    } catch (const std::exception& e) {
        failed_ = true;
        dMessage(0, "sound stops here: %s", e.what());
    }
}

std::shared_ptr<const ModalVoiceModel> SoundWorld::voice_model(dSoftBodyID body) {
    dSoftModalBasis basis{};
    basis.struct_size = sizeof basis;
    if (!dSoftBodyGetModalBasis(body, &basis))
        throw std::runtime_error("a body's modes can't be had");
    std::weak_ptr<const ModalVoiceModel>& place = voice_model_[basis.identity];
    if (auto known = place.lock())
        return known;
    const int* triangle = nullptr;
    const int triangles = dSoftBodyGetTriangles(body, &triangle);
    const SurfaceNumbers own({triangle, 3 * static_cast<std::size_t>(triangles)},
                             static_cast<std::size_t>(basis.node_count));
    BoundaryMesh mesh;
    mesh.triangle = own.triangle;
    for (const int n : own.node)
        mesh.node.emplace_back(basis.rest + 3 * n);
    std::vector<double> shape;
    for (int k = 0; k < basis.mode_count; ++k)
        for (const int n : own.node)
            for (int axis = 0; axis < 3; ++axis)
                shape.push_back(
                    static_cast<double>(basis.shape[(3 * n + axis) * basis.stride + k]));
    const auto modes = static_cast<std::size_t>(basis.mode_count);
    const auto made = cost_.run_once([&] {
        return make_voice_model({basis.omega, modes}, {basis.decay, modes}, mesh, shape,
                                scene_.settings(), kept_tables());
    });
    place = made;
    return made;
}

void SoundWorld::on_modal(const dSoftModalState& state) noexcept {
    if (failed_)
        return;
    try {
        const auto modes = static_cast<std::size_t>(state.mode_count);
        ModalView view{state.time,         state.dt, {state.amplitude, modes}, {state.rate, modes},
                       Vec3(state.center), {},       Vec3(state.velocity),     Vec3(state.spin)};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                view.rotation(i, j) = state.rotation[4 * i + j];
        const int* triangle = nullptr;
        const int triangles = dSoftBodyGetTriangles(state.body, &triangle);
        cost_.run([&] {
            scene_.push(state.body, {triangle, 3 * static_cast<std::size_t>(triangles)}, view,
                        [&] { return voice_model(state.body); });
        });
    } catch (const std::exception& e) {
        failed_ = true;
        dMessage(0, "sound stops here: %s", e.what());
    }
}

std::shared_ptr<RigidBody> SoundWorld::add_rigid(dBodyID body,
                                                 std::shared_ptr<const RigidModel> model) {
    const bool first = rigid_.empty();
    std::shared_ptr<RigidBody> made = rigid_.add(body, std::move(model));
    if (first && observing_) { // from now on it matters what pushes rigid bodies
        ignore();
        observe();
    }
    return made;
}

void SoundWorld::on_rigid_pushes(const dSoftRigidPushes& pushes) noexcept {
    if (failed_)
        return;
    try {
        cost_.run([&] { rigid_.feel(pushes, scene_, rigid_models_); });
    } catch (const std::exception& e) {
        failed_ = true;
        dMessage(0, "sound stops here: %s", e.what());
    }
}

void SoundWorld::strike(RigidBody& body, const Vec3& point, const Vec3& impulse, double contact) {
    if (scene_.listeners() > 0 && body.body)
        rigid_.strike(body, point, impulse, contact, stepped_, scene_, rigid_models_);
}

void SoundWorld::end_step(double time, double settled) {
    scene_.end_step(time, settled);
    occlusion_.update(scene_, rigid_, time - stepped_);
    alarm_.update(
        scene_, time, &fare_of,
        [this](const void* body, double when, Alarm::Cause cause) { raise(body, when, cause); });
    stepped_ = time;
}

void SoundWorld::on_step(double time) noexcept {
    if (failed_)
        return;
    follows_rigid_ = !rigid_.empty();
    try {
        cost_.run_whole([&] {
            if (follows_rigid_)
                rigid_.begin_step(world_, stepped_, scene_);
            else
                end_step(time, time);
        });
    } catch (const std::exception& e) {
        failed_ = true;
        dMessage(0, "sound stops here: %s", e.what());
    }
}

void SoundWorld::on_moved(double time) noexcept {
    if (failed_ || !follows_rigid_)
        return;
    try {
        cost_.run_whole([&] {
            const double begin = stepped_;
            rigid_.end_step(time, scene_, rigid_models_);
            end_step(time, begin);
        });
    } catch (const std::exception& e) {
        failed_ = true;
        dMessage(0, "sound stops here: %s", e.what());
    }
}

void SoundWorld::raise(const void* key, double time, Alarm::Cause cause) {
    const dSoftBodyID body = static_cast<dSoftBodyID>(const_cast<void*>(key));
    const char* const words = cause == Alarm::Cause::kHeard ? "vibrates as nothing stable does"
                              : cause == Alarm::Cause::kRedone
                                  ? "had to be taken back to the start of a step"
                                  : "has been stopped";
    dMessage(0,
             "instability alarm at %.6f s: soft body %p %s; give it a shorter substep "
             "(dSoftBodySetSubstep) or a stable integrator",
             time, static_cast<void*>(body), words);
    if (tell_)
        tell_(body, time);
}

void SoundWorld::on_body_end(dSoftBodyID body) noexcept {
    alarm_.forget(body);
    pace_.forget(body);
    rigid_.forget(body);
    scene_.end_body(body);
}

void SoundWorld::on_world_end() noexcept {
    occlusion_.set(nullptr, 0); // the space may end with the world
    world_ = nullptr;
    observing_ = false;
    if (ended_)
        return;
    ended_ = true;
    if (!failed_)
        play_out();
    for (const auto& listener : scene_.all())
        listener->for_each_sink([](Sink& sink) { sink.close(); });
}

void SoundWorld::play_out() noexcept {
    try {
        scene_.finish();
    } catch (const std::exception& e) {
        failed_ = true;
        dMessage(0, "sound stops here: %s", e.what());
    }
}

} // namespace ode::sound
