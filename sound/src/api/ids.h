#pragma once

#include "bridge/sound_world.h"

#include <ode_sound/sound.h>

#include <vector>

/// A sound world and the ids of its listeners, which end with it.
struct dxSoundWorld {
    explicit dxSoundWorld(dSoftWorldID soft) : world(soft) {}
    ode::sound::SoundWorld world;
    std::vector<dSoundListenerID> listeners; ///< owned
};

struct dxSoundListener {
    ~dxSoundListener(); ///< lets its sinks go
    dSoundWorldID owner = nullptr;
    ode::sound::Listener* listener = nullptr; ///< the world's
};

namespace ode::sound {

/// The sink behind an id (sink.cpp).
Sink& sink_of(dSoundSinkID sink) noexcept;

/// Takes a sink from the listener that has it, if any. dSoundSinkDestroy() calls this first.
void let_go(Sink& sink) noexcept;

} // namespace ode::sound
