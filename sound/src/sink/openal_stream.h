#pragma once

#include "sink/frame_ring.h"
#include "sink/gap_fader.h"
#include "sink/openal_device.h"
#include "sink/openal_loop.h"
#include "sink/sink.h"

#include <functional>
#include <vector>

namespace ode::sound {

/// Carries a ring's frames to an OpenAL device as soon as they are there: all that the simulation
/// is ahead is with the device, so that whoever is late, simulation or feeder, may be late by all
/// of it. (Of three buffers queued, the ring must hold a whole fourth one before the last of them
/// plays, which leaves no more than one buffer's time.)
///
/// Where the stream gets short, what GapFader would bridge with is written behind it. If the device
/// comes to that, an underrun is counted; the stream then goes on where it stopped: nothing is
/// skipped, the delay grows by the gap.
///
/// Used by one thread at a time.
class OpenAlStream {
public:
    static constexpr std::size_t kMinFrames = 256;

    /// @param tell  gets a sentence for each way in which sound will not be exact.
    /// @throws Refused
    OpenAlStream(OpenAlDevice device, const Format& format,
                 const std::function<void(const char*)>& tell);

    OpenAlContext& context() noexcept { return context_; }
    /// Mixed by the device at a time.
    std::size_t period() const noexcept { return period_; }
    /// Frames that the ring must hold before the device starts, as the device takes a period at
    /// once and another must be left.
    std::size_t lead() const noexcept { return 2 * (period_ + kMinFrames); }

    /// Hands over what the ring holds. Call more often than the simulation is ahead, within an
    /// OpenAlContext::Scope.
    /// @param ending  nothing will be added to the ring: plays it out, then silence until the
    ///                device has let all of it out.
    void pump(FrameRing& ring, bool ending) noexcept;

    bool finished() const noexcept { return finished_; }
    /// Frames of the stream that the device has taken.
    std::size_t played_frames() const noexcept;
    /// Frames that it has taken, bridges and silence included.
    std::size_t position() const noexcept { return position_; }
    unsigned long underruns() const noexcept { return underruns_; }

private:
    void follow() noexcept;
    std::size_t advance() const noexcept;
    void bridge() noexcept;
    void hand_over(FrameRing& ring, bool ending) noexcept;
    void rehearse() noexcept;
    void play_out() noexcept;

    OpenAlContext context_;
    Format format_;
    std::size_t period_;
    std::size_t short_of_; ///< the bridge is written ahead when fewer frames are left
    OpenAlLoop loop_;
    GapFader fader_;
    GapFader rehearsal_; ///< what fader_ will do if nothing comes
    std::vector<float> block_;
    // Counted in the device's frames since it started:
    std::size_t position_ = 0;  ///< taken
    std::size_t written_ = 0;   ///< stream, and bridges that will be heard
    std::size_t rehearsed_ = 0; ///< the bridge ahead begins here; none where not `written_`
    std::size_t cleared_ = 0;   ///< silence again behind the device
    std::size_t gap_begin_ = 0, gap_end_ = 0; ///< the last bridge
    std::size_t end_ = 0;                     ///< when ending and all is written: out by then
    std::size_t handed_over_ = 0;             ///< frames of the stream
    unsigned long underruns_ = 0;
    bool started_ = false;
    bool in_gap_ = false;
    bool finished_ = false;
};

} // namespace ode::sound
