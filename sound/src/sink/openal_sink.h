#pragma once

#include "sink/first_error.h"
#include "sink/openal_stream.h"
#include "sink/sink.h"

#include <atomic>
#include <functional>
#include <memory>
#include <thread>

namespace ode::sound {

/// A device that goes away (but the application's own) is waited for: frames pass by at their pace,
/// unheard, and sound goes on at the present when a device is there again.
///
/// Plays live. write() puts frames into a lock-free ring; a thread of its own carries them to the
/// device through OpenAlStream, in a context of its own that the application never sees.
///
/// A simulation slower than real time leaves gaps: faded to silence, resumed where the sound
/// stopped, counted in underruns(). A pause of the simulation is a gap, too.
/// A simulation faster than real time fills the ring, which holds kRingSeconds at least. Then
/// write() takes only what fits, and error() says so: pacing belongs to the loop that steps, which
/// waits while backlog() is longer than the delay it accepts. Shorter runs need no pacing: close()
/// plays out the rest.
class OpenAlSink final : public Sink {
public:
    static constexpr double kRingSeconds = 10; ///< 5.5 MB at 48 kHz stereo

    using Tell = std::function<void(const char*)>;
    using OpenDevice = std::function<OpenAlDevice()>;

    /// @param device  to play on; taken over.
    /// @param tell    gets warnings, within open().
    /// @param again   opens a device after the first was lost; throws Refused while there is none.
    explicit OpenAlSink(
        OpenAlDevice device, Tell tell = [](const char*) {},
        OpenDevice again = &OpenAlDevice::open_default);
    OpenAlSink(const OpenAlSink&) = delete;
    OpenAlSink& operator=(const OpenAlSink&) = delete;
    ~OpenAlSink() override { close(); }

    bool open(const Format& format) override;
    std::size_t write(std::span<const float> interleaved) noexcept override;
    void close() noexcept override;
    const char* error() const noexcept override { return error_.text(); }
    const char* kind() const noexcept override { return "openal"; }
    unsigned long underruns() const noexcept override { return underruns_.load(); }
    std::size_t backlog() const noexcept override;
    int rate() const noexcept override { return format_.rate; }
    double latency() const noexcept override;

    /// Times that the device went away.
    unsigned long lost_devices() const noexcept { return lost_devices_; }
    /// Frames that the device takes at a time; 0 before open().
    std::size_t period() const noexcept { return stream_ ? stream_->period() : 0; }
    /// Frames that it starts with.
    std::size_t lead() const noexcept { return stream_ ? stream_->lead() : 0; }

private:
    void feed() noexcept;
    bool play() noexcept;
    bool await_device() noexcept;

    OpenAlDevice device_;
    Tell tell_;
    OpenDevice again_;
    std::size_t before_ = 0; ///< frames that went by before this device
    Format format_{0, 1};
    std::unique_ptr<FrameRing> ring_;
    std::unique_ptr<OpenAlStream> stream_; ///< of the feeder thread while that runs
    std::thread feeder_;
    std::atomic<bool> ending_{false};
    std::atomic<bool> dead_{false}; ///< the device is gone, or the sink is closed
    std::atomic<unsigned long> underruns_{0};
    std::atomic<unsigned long> lost_devices_{0};
    std::atomic<std::size_t> played_{0};
    std::atomic<std::size_t> waited_{0}; ///< sum of backlogs [frames]
    std::atomic<std::size_t> looks_{0};  ///< summed up
    FirstError error_;
};

} // namespace ode::sound
