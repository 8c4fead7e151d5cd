#pragma once

#include "sink/openal_device.h"

#include <AL/alc.h>
#include <AL/alext.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace ode::sound::test {

/// A device whose output the test pulls, through OpenAL's real mixer (ALC_SOFT_loopback). It plays
/// the sound card's part; the sink owns and closes it.
class Loopback {
public:
    Loopback() {
        const auto open = reinterpret_cast<LPALCLOOPBACKOPENDEVICESOFT>(
            alcGetProcAddress(nullptr, "alcLoopbackOpenDeviceSOFT"));
        render_ = reinterpret_cast<LPALCRENDERSAMPLESSOFT>(
            alcGetProcAddress(nullptr, "alcRenderSamplesSOFT"));
        device_ = open ? open(nullptr) : nullptr;
        if (!device_)
            throw std::runtime_error("this OpenAL library has no loopback device");
    }

    OpenAlDevice device() {
        OpenAlDevice device;
        device.handle.reset(device_);
        device.loopback = true;
        return device;
    }

    /// Appends the next frames (stereo) to `heard`.
    void render(std::size_t frames, std::vector<float>& heard) {
        heard.resize(heard.size() + 2 * frames);
        render_(device_, &heard[heard.size() - 2 * frames], static_cast<ALCsizei>(frames));
    }

private:
    ALCdevice* device_ = nullptr;
    LPALCRENDERSAMPLESSOFT render_ = nullptr;
};

} // namespace ode::sound::test
