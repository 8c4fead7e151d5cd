#pragma once

#include <ode_sound/sound.h>

namespace ode::sound {

/// Sound worlds and sinks that the application has made and not destroyed. A process that leaves
/// main() or calls exit() without destroying them still gets its files whole: worlds play out, then
/// sinks close. Other threads must not step then. Creation and destruction from any thread.
void keep(dSoundWorldID world);
void keep(dSoundSinkID sink);
void forget(dSoundWorldID world) noexcept;
void forget(dSoundSinkID sink) noexcept;
/// The sound world made last over a soft world; null: none.
dSoundWorldID sound_of(dSoftWorldID world) noexcept;

} // namespace ode::sound
