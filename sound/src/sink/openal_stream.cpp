#include "sink/openal_stream.h"

#include <algorithm>
#include <bit>

namespace ode::sound {
namespace {

constexpr std::size_t kDevicePeriods = 4; ///< OpenAL Soft keeps three by default; one to be sure
constexpr std::size_t kResampler = 64;    ///< frames about the position that it may look at
constexpr std::size_t kBlock = 1024;

/// Half a second, so that a thread kept waiting does not lose count; ever so much for the fades.
std::size_t loop_frames(int rate, std::size_t period) {
    return std::bit_ceil(std::max({static_cast<std::size_t>(rate) / 2, 8 * GapFader::kFade,
                                   16 * (period + OpenAlStream::kMinFrames)}));
}

} // namespace

OpenAlStream::OpenAlStream(OpenAlDevice device, const Format& format,
                           const std::function<void(const char*)>& tell)
    : context_(std::move(device), format.rate), format_(format),
      // The device's period in frames of the stream.
      period_((static_cast<std::size_t>(context_.period_frames()) *
                   static_cast<std::size_t>(format.rate) +
               static_cast<std::size_t>(context_.rate()) - 1) /
              static_cast<std::size_t>(context_.rate())),
      short_of_(period_ + static_cast<std::size_t>(format.rate) / 100),
      loop_(context_, format, loop_frames(format.rate, period_), tell), fader_(format.channels),
      rehearsal_(format.channels), block_(kBlock * static_cast<std::size_t>(format.channels)) {}

void OpenAlStream::pump(FrameRing& ring, bool ending) noexcept {
    if (finished_)
        return;
    if (started_) {
        follow();
        if (position_ > written_ && end_ == 0)
            bridge();
    } else if (ring.size() < lead() && !ending) {
        return;
    }
    hand_over(ring, ending);
    if (ending && ring.size() == 0) {
        play_out();
        return;
    }
    if (written_ - position_ < short_of_ && rehearsed_ != written_)
        rehearse();
    if (!started_)
        loop_.play();
    started_ = true;
}

/// Where the device is; what it has left behind is silenced, lest it be heard again.
void OpenAlStream::follow() noexcept {
    if (!loop_.playing())
        loop_.play(); // the application reset its device
    position_ += advance();
    if (position_ > cleared_ + kResampler) {
        loop_.silence(cleared_, position_ - kResampler - cleared_);
        cleared_ = position_ - kResampler;
    }
}

/// Frames that the device took since the last look. OpenAL never tells while it is mixing.
std::size_t OpenAlStream::advance() const noexcept {
    return (loop_.position() - position_) & (loop_.size() - 1);
}

/// The device is beyond the stream's last frame: on the bridge that was rehearsed, or silent.
void OpenAlStream::bridge() noexcept {
    const bool rehearsed = rehearsed_ == written_;
    if (!in_gap_ || !rehearsed)
        ++underruns_;
    in_gap_ = true;
    if (gap_end_ != written_)
        gap_begin_ = written_;
    while (rehearsed && written_ < position_) { // the same bits once more
        const std::size_t frames = std::min(position_ - written_, kBlock);
        fader_.fill(std::span(block_).first(frames * static_cast<std::size_t>(format_.channels)),
                    0);
        written_ += frames;
    }
    if (!rehearsed) // it fell silent with a step that nobody can undo
        fader_.restart();
    gap_end_ = written_ = position_;
    if (rehearsed)
        rehearsed_ = written_; // which goes on from here
}

void OpenAlStream::hand_over(FrameRing& ring, bool ending) noexcept {
    // A gap is over when some time's worth came: dribs and drabs are one underrun, not many.
    if (in_gap_ && !ending && ring.size() < period_ + kMinFrames)
        return;
    const bool resumed = in_gap_;
    const std::size_t most = position_ + loop_.size() / 4; // the rest waits in the ring
    const std::size_t begin = written_;
    while (written_ < most) {
        const auto block = std::span(block_).first(std::min(kBlock, most - written_) *
                                                   static_cast<std::size_t>(format_.channels));
        const std::size_t frames = ring.read(block);
        if (frames == 0)
            break;
        const auto filled = block.first(frames * static_cast<std::size_t>(format_.channels));
        fader_.fill(filled, frames);
        loop_.write(written_, filled);
        written_ += frames;
        handed_over_ += frames;
        in_gap_ = false;
    }
    // Kept waiting between the look and the writing: the device may have been there first.
    if (started_ && !resumed && written_ > begin && position_ + advance() > begin)
        ++underruns_;
}

/// The bridge as it will be if nothing comes, and silence after it.
void OpenAlStream::rehearse() noexcept {
    rehearsal_ = fader_;
    for (std::size_t done = 0; done < GapFader::kFade + kBlock; done += kBlock) {
        rehearsal_.fill(block_, 0);
        loop_.write(written_ + done, block_);
    }
    rehearsed_ = written_;
}

void OpenAlStream::play_out() noexcept {
    if (end_ == 0) {
        if (handed_over_ > 0)
            rehearse();
        end_ = written_ + (handed_over_ > 0 ? GapFader::kFade + kDevicePeriods * period_ : 0);
    }
    if (!started_ && handed_over_ > 0)
        loop_.play();
    started_ = true;
    finished_ = position_ >= end_;
    if (finished_)
        loop_.stop();
}

std::size_t OpenAlStream::played_frames() const noexcept {
    if (position_ >= written_)
        return handed_over_;
    const std::size_t bridged = gap_end_ - std::clamp(position_, gap_begin_, gap_end_);
    return handed_over_ - std::min(handed_over_, written_ - position_ - bridged);
}

} // namespace ode::sound
