#include "sink/openal_loop.h"

#include <AL/alext.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace ode::sound {
namespace {

// AL_SOFTX_map_buffer, which the installed headers don't have.
using Storage = void(AL_APIENTRY*)(ALuint, ALenum, const ALvoid*, ALsizei, ALsizei, unsigned);
using Map = void*(AL_APIENTRY*)(ALuint, ALsizei, ALsizei, unsigned);
constexpr unsigned kMapWrite = 2, kMapPersistent = 4; ///< writable while a source plays it

} // namespace

OpenAlLoop::OpenAlLoop(OpenAlContext& context, const Format& format, std::size_t frames,
                       const std::function<void(const char*)>& tell)
    : context_(context), channels_(format.channels), size_(frames),
      sample_format_(AL_FORMAT_STEREO_FLOAT32), stereo_(2 * kPiece), stereo16_(2 * kPiece) {
    if (format.channels != 1 && format.channels != 2)
        throw Refused("OpenAL sink: plays one or two channels, not " +
                      std::to_string(format.channels) + "; write those to a file");
    const OpenAlContext::Scope scope(context_);
    if (context_.rate() != format.rate)
        tell(("OpenAL sink: the device runs at " + std::to_string(context_.rate()) +
              " Hz and resamples sound rendered at " + std::to_string(format.rate) +
              " Hz; set the rate to the device's (dSoundSetRate) for exact sound")
                 .c_str());
    if (!alIsExtensionPresent("AL_EXT_FLOAT32")) {
        tell("OpenAL sink: this OpenAL library has no AL_EXT_FLOAT32, so sound is rounded to 16 "
             "bits; install OpenAL Soft for exact sound");
        sample_format_ = AL_FORMAT_STEREO16;
    }
    if (!alIsExtensionPresent("AL_SOFTX_map_buffer"))
        throw Refused("OpenAL sink: this OpenAL library has no AL_SOFTX_map_buffer, by which sound "
                      "is handed over; install OpenAL Soft 1.19 or later");
    const auto store = reinterpret_cast<Storage>(alGetProcAddress("alBufferStorageSOFT"));
    const auto map = reinterpret_cast<Map>(alGetProcAddress("alMapBufferSOFT"));
    flush_ = reinterpret_cast<Flush>(alGetProcAddress("alFlushMappedBufferSOFT"));
    unmap_ = reinterpret_cast<Unmap>(alGetProcAddress("alUnmapBufferSOFT"));

    // The application's error flag is the application's. Without roll-off its distance model does
    // nothing to our source.
    const bool shared = context_.is_borrowed();
    if (!shared)
        alGetError();
    alGenSources(1, &source_);
    alGenBuffers(1, &buffer_);
    const bool wide = sample_format_ == AL_FORMAT_STEREO_FLOAT32;
    const std::vector<float> zeros(2 * size_); // in 16 bits the same zeros
    const auto bytes = static_cast<ALsizei>(2 * size_ * (wide ? sizeof(float) : sizeof(short)));
    store(buffer_, sample_format_, zeros.data(), bytes, format.rate, kMapWrite | kMapPersistent);
    memory_ = map(buffer_, 0, bytes, kMapWrite | kMapPersistent);
    alSourcei(source_, AL_BUFFER, static_cast<ALint>(buffer_));
    alSourcei(source_, AL_LOOPING, AL_TRUE);
    alSourcei(source_, AL_SOURCE_RELATIVE, AL_TRUE);
    alSourcef(source_, AL_ROLLOFF_FACTOR, 0);
    if (alIsExtensionPresent("AL_SOFT_direct_channels"))
        alSourcei(source_, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);
    const bool made = alIsSource(source_) && memory_;
    const ALenum error = shared ? AL_NO_ERROR : alGetError();
    if (!made || error != AL_NO_ERROR)
        throw Refused("OpenAL refuses a source with a buffer (error " + std::to_string(error) +
                      "); the application may have too many sources");
}

OpenAlLoop::~OpenAlLoop() {
    const OpenAlContext::Scope scope(context_);
    stop();
    alSourcei(source_, AL_BUFFER, 0);
    alDeleteSources(1, &source_);
    unmap_(buffer_);
    alDeleteBuffers(1, &buffer_);
}

void OpenAlLoop::write(std::size_t at, std::span<const float> interleaved) noexcept {
    const auto channels = static_cast<std::size_t>(channels_);
    for (std::size_t rest = interleaved.size() / channels; rest > 0;) {
        const std::size_t frames = std::min(rest, kPiece);
        const float* const from = &interleaved[interleaved.size() - rest * channels];
        // OpenAL would pan a mono source; two equal channels go straight through.
        for (std::size_t i = 0; i < frames; ++i) {
            stereo_[2 * i] = from[i * channels];
            stereo_[2 * i + 1] = from[i * channels + channels - 1];
        }
        upload(at, frames);
        at += frames;
        rest -= frames;
    }
}

void OpenAlLoop::silence(std::size_t at, std::size_t frames) noexcept {
    std::fill(stereo_.begin(), stereo_.end(), 0.0F);
    for (; frames > 0; frames -= std::min(frames, kPiece)) {
        upload(at, std::min(frames, kPiece));
        at += std::min(frames, kPiece);
    }
}

void OpenAlLoop::upload(std::size_t at, std::size_t frames) noexcept {
    const bool wide = sample_format_ == AL_FORMAT_STEREO_FLOAT32;
    if (!wide)
        to_int16(std::span(stereo_).first(2 * frames), stereo16_);
    const std::size_t bytes = 2 * (wide ? sizeof(float) : sizeof(short)); // of a frame
    const auto* const data = wide ? reinterpret_cast<const char*>(stereo_.data())
                                  : reinterpret_cast<const char*>(stereo16_.data());
    const std::size_t begin = at % size_;
    const std::size_t first = std::min(frames, size_ - begin);
    const auto put = [&](const char* from, std::size_t to, std::size_t count) {
        if (count == 0)
            return;
        std::memcpy(static_cast<char*>(memory_) + to * bytes, from, count * bytes);
        flush_(buffer_, static_cast<ALsizei>(to * bytes), static_cast<ALsizei>(count * bytes));
    };
    put(data, begin, first);
    put(data + first * bytes, 0, frames - first);
}

std::size_t OpenAlLoop::position() const noexcept {
    ALint value = 0;
    alGetSourcei(source_, AL_SAMPLE_OFFSET, &value);
    return static_cast<std::size_t>(value);
}

bool OpenAlLoop::playing() const noexcept {
    ALint value = 0;
    alGetSourcei(source_, AL_SOURCE_STATE, &value);
    return value == AL_PLAYING;
}

void OpenAlLoop::play() noexcept { alSourcePlay(source_); }
void OpenAlLoop::stop() noexcept { alSourceStop(source_); }

void to_int16(std::span<const float> from, std::span<short> to) noexcept {
    std::transform(from.begin(), from.end(), to.begin(), [](float x) {
        const float scaled = std::clamp(x * 32767.0F, -32768.0F, 32767.0F);
        return scaled == scaled ? static_cast<short>(std::lrint(scaled)) : short{0};
    });
}

} // namespace ode::sound
