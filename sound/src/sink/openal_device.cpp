#include "sink/openal_device.h"

#include "sink/sink.h"

#include <AL/al.h>
#include <AL/alext.h>
#include <algorithm>
#include <array>
#include <string>

namespace ode::sound {
namespace {

int get(ALCdevice* device, ALCenum what) noexcept {
    ALCint value = 0;
    alcGetIntegerv(device, what, 1, &value);
    return value;
}

} // namespace

OpenAlDevice OpenAlDevice::open_default() {
    OpenAlDevice device;
    device.handle.reset(alcOpenDevice(nullptr));
    if (!device.handle)
        throw Refused("OpenAL finds no sound device; connect one, or write a file instead");
    return device;
}

OpenAlDevice OpenAlDevice::of_application() {
    OpenAlDevice device;
    device.context = alcGetCurrentContext();
    if (!device.context)
        throw Refused("no OpenAL context is current; make the application's own current first, or "
                      "let dSoundSinkCreateOpenAL() have one of its own");
    device.handle = {alcGetContextsDevice(device.context), Closer{true}};
    return device;
}

OpenAlContext::OpenAlContext(OpenAlDevice device, int rate) : device_(std::move(device)) {
    ALCdevice* const handle = device_.handle.get();
    if (!alcIsExtensionPresent(handle, "ALC_EXT_thread_local_context"))
        throw Refused("this OpenAL library has no ALC_EXT_thread_local_context, without which the "
                      "application's context would be disturbed; install OpenAL Soft");
    set_thread_context_ =
        reinterpret_cast<SetThreadContext>(alcGetProcAddress(handle, "alcSetThreadContext"));
    get_thread_context_ =
        reinterpret_cast<GetThreadContext>(alcGetProcAddress(handle, "alcGetThreadContext"));

    if (is_borrowed()) {
        context_ = device_.context;
        return;
    }
    // At the stream's rate nothing is resampled (OpenAL's linear resampler: THD+N -25 dB at 8 kHz).
    // The limiter would delay by 48 frames and clamp; HRTF would cost and do nothing, as channels
    // go straight to the loudspeakers.
    std::array<ALCint, 11> attributes{
        ALC_FREQUENCY, rate, ALC_OUTPUT_LIMITER_SOFT, ALC_FALSE, ALC_HRTF_SOFT, ALC_FALSE, 0};
    if (device_.loopback) {
        attributes[6] = ALC_FORMAT_CHANNELS_SOFT;
        attributes[7] = ALC_STEREO_SOFT;
        attributes[8] = ALC_FORMAT_TYPE_SOFT;
        attributes[9] = ALC_FLOAT_SOFT;
    }
    if (rate == 0) // as the device likes it
        attributes[0] = 0;
    context_ = alcCreateContext(handle, attributes.data());
    if (!context_)
        throw Refused("OpenAL refuses a context (error " + std::to_string(alcGetError(handle)) +
                      "); check that the sound device runs with another program");
}

int OpenAlContext::rate() const noexcept { return get(device_.handle.get(), ALC_FREQUENCY); }

int OpenAlContext::period_frames() const noexcept {
    if (device_.loopback)
        return 1; // as many as its owner asks for
    const int updates = std::max(get(device_.handle.get(), ALC_REFRESH), 1); // per second
    return (rate() + updates - 1) / updates;
}

bool OpenAlContext::connected() const noexcept {
    if (device_.connected)
        return device_.connected();
    return !alcIsExtensionPresent(device_.handle.get(), "ALC_EXT_disconnect") ||
           get(device_.handle.get(), ALC_CONNECTED) != 0;
}

OpenAlContext::Scope::Scope(OpenAlContext& context) noexcept
    : context_(context), before_(context.get_thread_context_()) {
    context_.set_thread_context_(context_.context_);
}

OpenAlContext::Scope::~Scope() { context_.set_thread_context_(before_); }

} // namespace ode::sound
