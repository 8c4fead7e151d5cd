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
    dSoundWorldID owner;
    ode::sound::Listener* listener; ///< the world's
};
