#pragma once

#include "sink/openal_device.h"
#include "sink/sink.h"

#include <AL/al.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace ode::sound {

/// An OpenAL source that goes round and round one buffer, which is written in memory ahead of where
/// it plays (AL_SOFTX_map_buffer, in OpenAL Soft from 1.19 on). What was written is with the device
/// at once, down to a single frame, and may still be written over until it is played; a queue of
/// buffers takes whole ones only, and a source that comes to its queue's end stops with a step.
///
/// The source reaches the loudspeakers as it is: relative to the listener, direct channels, no
/// distance model, unit gain, and so bit for bit.
///
/// Within an OpenAlContext::Scope, but for construction and destruction. No allocation after
/// construction.
class OpenAlLoop {
public:
    /// @param frames  its length; what is written lies less than that ahead of what plays.
    /// @param tell    gets a sentence for each way in which sound will not be exact.
    /// @throws Refused
    OpenAlLoop(OpenAlContext& context, const Format& format, std::size_t frames,
               const std::function<void(const char*)>& tell);
    OpenAlLoop(const OpenAlLoop&) = delete;
    OpenAlLoop& operator=(const OpenAlLoop&) = delete;
    ~OpenAlLoop();

    std::size_t size() const noexcept { return size_; } ///< [frames]

    /// @param at          the first frame's place, modulo the length.
    /// @param interleaved in the stream's channels.
    void write(std::size_t at, std::span<const float> interleaved) noexcept;
    void silence(std::size_t at, std::size_t frames) noexcept;

    /// Where the device reads next, modulo the length; it moves by whole periods of the device.
    std::size_t position() const noexcept;
    bool playing() const noexcept;
    void play() noexcept; ///< from the beginning
    void stop() noexcept;

private:
    static constexpr std::size_t kPiece = 1024; ///< converted at a time [frames]

    void upload(std::size_t at, std::size_t frames) noexcept;

    OpenAlContext& context_;
    int channels_;
    std::size_t size_;
    ALenum sample_format_;
    ALuint source_ = 0, buffer_ = 0;
    void* memory_ = nullptr; ///< OpenAL's own, as long as the buffer
    using Flush = void(AL_APIENTRY*)(ALuint, ALsizei, ALsizei);
    using Unmap = void(AL_APIENTRY*)(ALuint);
    Flush flush_ = nullptr;
    Unmap unmap_ = nullptr;
    std::vector<float> stereo_; ///< one piece for the device
    std::vector<short> stereo16_;
};

/// Full scale to 16 bits, rounded, clipped; not-a-number is silence.
void to_int16(std::span<const float> from, std::span<short> to) noexcept;

} // namespace ode::sound
