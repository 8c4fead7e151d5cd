#pragma once

#include "bridge/sound_world.h"

#include <ode_sound/sound.h>

#include <vector>

/// A sound world and the ids of its listeners, which end with it.
struct dxSoundWorld {
    explicit dxSoundWorld(dSoftWorldID soft) : world(soft) {}
    ode::sound::SoundWorld world;
    std::vector<dSoundListenerID> listeners; ///< owned
    std::vector<dSoundModalID> modals;       ///< owned
};

struct dxSoundListener {
    dSoundWorldID owner;
    ode::sound::Listener* listener; ///< the world's
};

struct dxSoundModal {
    dSoundWorldID owner;
    std::shared_ptr<ode::sound::RigidBody> rigid;
};
