#include "bridge/sound_world.h"

#include <ode/error.h>

#include <exception>
#include <type_traits>

namespace ode::sound {
namespace {

static_assert(std::is_same_v<dReal, double>,
              "the sound path reads ODE's numbers in place: build ODE in double precision");

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
    observer.on_step = [](void* data, dSoftWorldID, dReal time) { self(data).on_step(time); };
    observer.on_body_end = [](void* data, dSoftBodyID body) { self(data).on_body_end(body); };
    observer.on_world_end = [](void* data, dSoftWorldID) { self(data).on_world_end(); };
    observing_ = dSoftWorldAddObserver(world_, &observer) != 0;
}

void SoundWorld::ignore() noexcept {
    if (observing_ && world_)
        dSoftWorldRemoveObserver(world_, this);
    observing_ = false;
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
        if (!triangle.empty())
            cost_.run([&] { scene_.push(substep.body, triangle, view); });
    } catch (const std::exception& e) {
        failed_ = true;
        dMessage(0, "sound stops here: %s", e.what());
    }
}

void SoundWorld::on_step(double time) noexcept {
    if (failed_)
        return;
    try {
        cost_.run_whole([&] { scene_.end_step(time); });
    } catch (const std::exception& e) {
        failed_ = true;
        dMessage(0, "sound stops here: %s", e.what());
    }
}

void SoundWorld::on_body_end(dSoftBodyID body) noexcept { scene_.end_body(body); }

void SoundWorld::on_world_end() noexcept {
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
