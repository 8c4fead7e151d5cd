#pragma once

#include "sink/frame_ring.h"
#include "sink/gap_fader.h"
#include "sink/openal_device.h"
#include "sink/sink.h"

#include <AL/al.h>

#include <array>
#include <functional>
#include <vector>

namespace ode::sound {

/// Feeds an OpenAL source from a ring through a queue of three buffers, each as long as the
/// device's period but at least 256 frames: 18 ms at 48 kHz where the device is configured for low
/// latency, 70 ms with OpenAL Soft's default period. Fewer or shorter buffers run dry
/// whenever the device takes a whole period at once.
///
/// The source reaches the loudspeakers as it is: relative to the listener, direct channels, no
/// distance model, unit gain, and so bit for bit.
///
/// While the ring is short, waits for the producer until the last buffer plays; then lets GapFader
/// bridge, and counts an underrun. The stream then goes on where it stopped: nothing is skipped,
/// the delay grows by the gap.
///
/// Used by one thread at a time.
class OpenAlStream {
public:
    static constexpr int kBuffers = 3;
    static constexpr int kMinFrames = 256;

    /// @param tell  gets a sentence for each way in which sound will not be exact.
    /// @throws Refused
    OpenAlStream(OpenAlDevice device, const Format& format,
                 const std::function<void(const char*)>& tell);
    OpenAlStream(const OpenAlStream&) = delete;
    OpenAlStream& operator=(const OpenAlStream&) = delete;
    ~OpenAlStream();

    OpenAlContext& context() noexcept { return context_; }
    int buffer_frames() const noexcept { return buffer_frames_; }

    /// Refills the buffers that were played. Call more often than a buffer lasts, within an
    /// OpenAlContext::Scope.
    /// @param ending  nothing will be added to the ring: plays it out, then silence until the
    ///                device has let all of it out.
    void pump(FrameRing& ring, bool ending) noexcept;

    bool finished() const noexcept { return finished_; }
    /// Frames of the stream that left the queue, and buffers that did, bridges and silence
    /// included.
    std::size_t played_frames() const noexcept { return played_frames_; }
    std::size_t played_buffers() const noexcept { return played_buffers_; }
    unsigned long underruns() const noexcept { return underruns_; }

private:
    struct Buffer {
        ALuint id = 0;
        std::size_t frames = 0; ///< of the stream; the rest is bridge or silence
    };

    void reclaim() noexcept;
    bool refill(FrameRing& ring, bool ending) noexcept;
    void upload(ALuint buffer) noexcept;
    void play(int fresh) noexcept;
    int state() const noexcept;

    OpenAlContext context_;
    Format format_;
    ALenum sample_format_ = 0;
    int buffer_frames_ = 0;
    std::size_t tail_frames_ = 0; ///< after the end: the bridge and the device's own delay
    ALuint source_ = 0;
    std::array<Buffer, kBuffers> buffer_; ///< a ring: queued ones from first_ on, then free ones
    int first_ = 0;
    int queued_ = 0;
    GapFader fader_;
    std::vector<float> block_;  ///< one buffer in the stream's channels
    std::vector<float> stereo_; ///< the same for the device
    std::vector<short> stereo16_;
    std::size_t played_frames_ = 0;
    std::size_t played_buffers_ = 0;
    unsigned long underruns_ = 0;
    bool started_ = false;
    bool in_gap_ = false;
    bool finished_ = false;
};

/// Full scale to 16 bits, rounded, clipped; not-a-number is silence.
void to_int16(std::span<const float> from, std::span<short> to) noexcept;

} // namespace ode::sound
