#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>

namespace ode::sound {

struct Format {
    int rate;     ///< frames per second [Hz]
    int channels; ///< samples per frame; 1 mono, 2 left and right
    bool operator==(const Format&) const = default;
};

/// What full scale stands for, for sinks that write it down.
struct Calibration {
    double full_scale = 20.0;   ///< in `unit`
    const char* unit = "Pa";    ///< static
    const char* radiation = ""; ///< static
    const char* sampling = "";  ///< static
    double start = 0.0;         ///< of the first frame [s of the simulation]
};

/// A sink that cannot be made: one sentence with the thing, the reason and the cure. Creation only.
class Refused : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Where finished samples go. The mixer pushes and a sink never calls back, so that every kind of
/// sink receives the same bits. Samples are relative to full scale (1.0) and interleaved.
///
/// Life: open() once, write() any number of times, close(). All from the stepping thread; error(),
/// underruns() and backlog() from any thread.
class Sink {
public:
    virtual ~Sink() = default;

    /// Opening again with the same format continues the stream.
    /// @return false when refused; error() says why, and write() forgets what it gets.
    virtual bool open(const Format& format) = 0;

    /// After open(), and again when it changes.
    virtual void calibrate(const Calibration&) {}

    /// Takes whole frames from the front; never waits for a device or for another thread.
    /// @return frames taken. Fewer than offered means full for now: the caller keeps or drops the
    /// rest. A sink that failed, was closed or was never opened takes all and forgets it, so that
    /// nobody retries in vain.
    virtual std::size_t write(std::span<const float> interleaved) noexcept = 0;

    /// Plays out or finalises. May wait for as long as the backlog lasts. Idempotent.
    virtual void close() noexcept = 0;

    /// First failure in words the user can act on; "" while healthy. Lives as long as the sink.
    virtual const char* error() const noexcept = 0;
    virtual const char* kind() const noexcept = 0;

    /// Times a live device ran out of samples.
    virtual unsigned long underruns() const noexcept { return 0; }

    /// Frames taken and not yet played: by how much the simulation is ahead of a live device. A
    /// loop that steps faster than real time waits while this is large. 0 for sinks without a
    /// clock.
    virtual std::size_t backlog() const noexcept { return 0; }

    /// Of the clock that backlog() is counted by [Hz]; 0 for sinks without one.
    virtual int rate() const noexcept { return 0; }

    /// Mean time from write() to the loudspeaker's driver so far [s]; 0 for sinks without a clock.
    virtual double latency() const noexcept { return 0.0; }
};

} // namespace ode::sound
