#pragma once

#include "sink/frame_ring.h"
#include "sink/sink.h"

#include <memory>
#include <vector>

namespace ode::sound {

/// Several streams as the channels of one sink: each of its parts is a sink for one listener. A
/// frame goes on when all parts have it. A part that stays away for kRingSeconds (its listener
/// ended) is silent from then on, until it comes again.
///
/// All from the stepping thread, but what a Sink allows from any. Allocates when opened only.
class SideBySide {
public:
    static constexpr double kRingSeconds = 1;

    /// @param whole     gets all.
    /// @param channels  of each part, in the order of their channels.
    SideBySide(std::shared_ptr<Sink> whole, const std::vector<int>& channels);
    SideBySide(const SideBySide&) = delete;
    SideBySide& operator=(const SideBySide&) = delete;

    /// Ends with this object, which its user keeps.
    const std::vector<std::shared_ptr<Sink>>& parts() const noexcept { return parts_; }

    /// Hands on what only some parts have, with silence for the others. Then close the whole.
    void finish() noexcept { hand_on(true); }

private:
    class Part;

    bool open(const Format& format, std::size_t part);
    std::size_t write(std::span<const float> interleaved, std::size_t part) noexcept;
    void hand_on(bool all) noexcept;

    static constexpr std::size_t kBlock = 256; ///< frames put together at a time

    std::shared_ptr<Sink> whole_;
    std::vector<int> channels_;
    int all_channels_;
    std::vector<std::shared_ptr<Sink>> parts_;
    std::vector<std::unique_ptr<FrameRing>> ring_; ///< of each part
    std::vector<float> part_, block_;              ///< of one part, of all
    std::size_t in_block_ = 0, taken_ = 0;         ///< frames of block_; of these handed on
};

} // namespace ode::sound
