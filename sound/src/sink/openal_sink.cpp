#include "sink/openal_sink.h"

#include <algorithm>
#include <chrono>
#include <exception>

namespace ode::sound {
namespace {

using std::chrono::milliseconds;

/// Playing out is given up when the device took nothing for this long: far beyond any period.
constexpr milliseconds kStuck{500};
constexpr milliseconds kConnectionCheck{500};

} // namespace

OpenAlSink::OpenAlSink(OpenAlDevice device, Tell tell)
    : device_(std::move(device)), tell_(std::move(tell)) {}

bool OpenAlSink::open(const Format& format) {
    if (dead_) {
        error_.set("OpenAL sink: closed already; make another");
        return false;
    }
    if (format_.rate != 0 && format == format_)
        return true;
    if (format_.rate != 0) {
        error_.set("OpenAL sink: already open with %d Hz and %d channels; make another for %d Hz "
                   "and %d channels",
                   format_.rate, format_.channels, format.rate, format.channels);
        return false;
    }
    format_ = format;
    try {
        stream_ = std::make_unique<OpenAlStream>(std::move(device_), format, tell_);
        ring_ = std::make_unique<FrameRing>(static_cast<std::size_t>(kRingSeconds * format.rate),
                                            format.channels);
        feeder_ = std::thread([this] { feed(); });
        return true;
    } catch (const std::exception& e) {
        error_.set("%s", e.what());
        dead_ = true;
        return false;
    }
}

std::size_t OpenAlSink::write(std::span<const float> interleaved) noexcept {
    const std::size_t offered = interleaved.size() / static_cast<std::size_t>(format_.channels);
    if (dead_ || !ring_)
        return offered;
    const std::size_t taken = ring_->write(interleaved);
    if (taken < offered)
        error_.set(
            "OpenAL sink: sound is more than %.0f s ahead of the loudspeaker, so some is "
            "lost; slow the loop down while dSoundSinkGetBacklog() is large, or write a file",
            kRingSeconds);
    return taken;
}

void OpenAlSink::close() noexcept {
    ending_ = true;
    if (feeder_.joinable())
        feeder_.join();
    dead_ = true;
    stream_.reset();
    device_.handle.reset();
}

std::size_t OpenAlSink::backlog() const noexcept {
    if (dead_ || !ring_)
        return 0;
    const std::size_t played = played_.load(std::memory_order_acquire); // before what grows faster
    return ring_->written() - played;
}

void OpenAlSink::feed() noexcept {
    using Clock = std::chrono::steady_clock;
    const OpenAlContext::Scope scope(stream_->context());
    const milliseconds nap(std::clamp(250 * stream_->buffer_frames() / format_.rate, 1, 5));
    auto last_check = Clock::now();
    auto last_progress = last_check;
    std::size_t last_buffers = 0;
    for (;;) {
        const bool ending = ending_.load(std::memory_order_acquire);
        stream_->pump(*ring_, ending);
        underruns_.store(stream_->underruns());
        // After the refill, so that whoever sees the count sees a full queue behind it.
        played_.store(stream_->played_frames(), std::memory_order_release);
        const auto now = Clock::now();
        if (!ending || stream_->played_buffers() != last_buffers) {
            last_buffers = stream_->played_buffers();
            last_progress = now;
        }
        if (stream_->finished() || (ending && now - last_progress > kStuck))
            return;
        if (now - last_check > kConnectionCheck) {
            last_check = now;
            if (!stream_->context().connected()) {
                error_.set("OpenAL sink: the sound device was disconnected; connect it and make "
                           "another sink");
                dead_ = true;
                return;
            }
        }
        std::this_thread::sleep_for(nap);
    }
}

} // namespace ode::sound
