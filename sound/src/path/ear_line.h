#pragma once

#include "dsp/dc_block.h"
#include "dsp/decimator.h"
#include "dsp/kernels.h"
#include "dsp/storage.h"
#include "path/line.h"

#include <optional>

namespace ode::sound {

/// Accumulation buffer of one ear (P01 3.3): waves are added where they will arrive, and read when
/// their time has come.
///
/// Runs at twice the audio rate, so that the splat's kernel has an octave and a half for its
/// transition, and leaves through a decimator.
class EarLine final : public Line {
public:
    /// @param rate   audio rate [Hz].
    /// @param frame  first audio frame to come (time * rate).
    /// @param block  P01 eq. 9, for radiation "paper". The paper filters every triangle; the filter
    ///               is linear, so that once an ear is the same but for motion within its 10
    ///               samples.
    EarLine(double rate, std::int64_t frame, const Decimator& decimator,
            std::optional<DcBlock> block);

    /// Where waves sent at a grid sample may land. Position and velocity are the caller's to fill.
    SplatEar target(std::int64_t sample) noexcept;
    /// @param arrival  grid sample of the latest wave sent, see Kernels::splat.
    void note_arrival(double arrival) noexcept;

    void read(int frames, double* out) noexcept override;
    std::int64_t last_frame() const noexcept override;

    /// Grid samples needed behind an audio frame's own before it can be read.
    static int lookahead(double rate) noexcept;

private:
    static constexpr int kBlock = 64; ///< frames

    double pull() noexcept;

    Decimator decimator_;
    std::optional<DcBlock> block_;
    std::int64_t pulled_; ///< grid sample that is taken from the ring next
    std::int64_t latest_; ///< last grid sample that anything was sent to
    std::int64_t mask_;
    AlignedVector ring_[SplatEar::kCopies];
    AlignedVector window_; ///< grid samples, the first `reach` before the next frame's own
    std::size_t held_ = 0; ///< of them
};

} // namespace ode::sound
