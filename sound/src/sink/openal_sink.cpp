#include "sink/openal_sink.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <sched.h>

namespace ode::sound {
namespace {

using std::chrono::milliseconds;

/// Playing out is given up when the device took nothing for this long: far beyond any period.
constexpr milliseconds kStuck{500};
constexpr milliseconds kConnectionCheck{500};

/// Lets the calling thread go before those that compute, where the system permits it
/// (RLIMIT_RTPRIO): it works for some microseconds a millisecond, and is not to wait for others'
/// turns to end.
void go_first() noexcept {
    sched_param parameters{};
    parameters.sched_priority = sched_get_priority_min(SCHED_RR);
    sched_setscheduler(0, SCHED_RR | SCHED_RESET_ON_FORK, &parameters);
}

} // namespace

OpenAlSink::OpenAlSink(OpenAlDevice device, Tell tell, OpenDevice again)
    : device_(std::move(device)), tell_(std::move(tell)), again_(std::move(again)) {}

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

double OpenAlSink::latency() const noexcept {
    const std::size_t looks = looks_.load();
    return looks > 0
               ? static_cast<double>(waited_.load()) / static_cast<double>(looks) / format_.rate
               : 0.0;
}

void OpenAlSink::feed() noexcept {
    go_first();
    while (!play())
        if (!await_device())
            return;
}

/// @return whether all is played; else the device is gone.
bool OpenAlSink::play() noexcept {
    using Clock = std::chrono::steady_clock;
    const OpenAlContext::Scope scope(stream_->context());
    const milliseconds nap(
        std::clamp(500 * static_cast<int>(stream_->period()) / format_.rate, 1, 5));
    const unsigned long underruns = underruns_;
    auto last_check = Clock::now();
    auto last_progress = last_check;
    std::size_t last_position = 0;
    for (;;) {
        const bool ending = ending_.load(std::memory_order_acquire);
        stream_->pump(*ring_, ending);
        underruns_.store(underruns + stream_->underruns());
        // After the hand-over, so that whoever sees the count sees the rest with the device.
        played_.store(before_ + stream_->played_frames(), std::memory_order_release);
        if (stream_->played_frames() > 0) {
            waited_ += backlog();
            ++looks_;
        }
        const auto now = Clock::now();
        if (!ending || stream_->position() != last_position) {
            last_position = stream_->position();
            last_progress = now;
        }
        if (stream_->finished() || (ending && now - last_progress > kStuck))
            return true;
        if (now - last_check > kConnectionCheck) {
            last_check = now;
            if (!stream_->context().connected())
                return false;
        }
        std::this_thread::sleep_for(nap);
    }
}

/// @return false when nothing more will come.
bool OpenAlSink::await_device() noexcept {
    using Clock = std::chrono::steady_clock;
    error_.set(
        "OpenAL sink: the sound device was disconnected; sound goes on when one is connected");
    ++lost_devices_;
    stream_.reset();
    const std::size_t gone = ring_->written() - ring_->size(); // what was queued is lost with it
    std::vector<float> unheard;
    try {
        unheard.resize(ring_->capacity() * static_cast<std::size_t>(format_.channels));
    } catch (const std::exception&) {
        dead_ = true;
        return false;
    }
    before_ = gone;
    const auto begin = Clock::now();
    auto next_try = begin + kConnectionCheck;
    for (;;) {
        if (ending_.load(std::memory_order_acquire))
            return false;
        const double passed = std::chrono::duration<double>(Clock::now() - begin).count();
        const auto due = gone + static_cast<std::size_t>(passed * format_.rate);
        if (due > before_)
            before_ +=
                ring_->read(std::span(unheard).first(std::min(due - before_, ring_->capacity()) *
                                                     static_cast<std::size_t>(format_.channels)));
        played_.store(before_, std::memory_order_release);
        if (Clock::now() >= next_try) {
            next_try += kConnectionCheck;
            try {
                stream_ = std::make_unique<OpenAlStream>(again_(), format_, [](const char*) {});
                return true;
            } catch (const std::exception&) { // not yet
            }
        }
        std::this_thread::sleep_for(milliseconds(5));
    }
}

} // namespace ode::sound
