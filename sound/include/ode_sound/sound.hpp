/** @file
 * Owning C++ handles over <ode_sound/sound.h>; see <ode_softbody/softbody.hpp>.
 */
#ifndef ODE_SOUND_SOUND_HPP
#define ODE_SOUND_SOUND_HPP

#include <ode_softbody/softbody.hpp>
#include <ode_sound/sound.h>

namespace ode::sound {

using WorldHandle = soft::Handle<dSoundWorldID, dSoundWorldDestroy>;
using ListenerHandle = soft::Handle<dSoundListenerID, dSoundListenerDestroy>;
using ModalHandle = soft::Handle<dSoundModalID, dSoundModalDestroy>;
using SinkHandle = soft::Handle<dSoundSinkID, dSoundSinkDestroy>;

} // namespace ode::sound

#endif
