#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

namespace ode::sound {

/// Lock-free queue of frames from one writing to one reading thread. Indices only grow, so that
/// full and empty differ; at 192 kHz they wrap after three million years.
class FrameRing {
public:
    FrameRing(std::size_t frames, int channels)
        : channels_(static_cast<std::size_t>(channels)), capacity_(std::bit_ceil(frames)),
          sample_(capacity_ * channels_) {}

    std::size_t capacity() const noexcept { return capacity_; }
    /// Frames waiting: a lower bound for the reader, an upper one for the writer.
    std::size_t size() const noexcept {
        const std::size_t read = read_.load(std::memory_order_acquire);
        return written_.load(std::memory_order_acquire) - read;
    }
    /// Frames ever written.
    std::size_t written() const noexcept { return written_.load(std::memory_order_acquire); }

    /// Writing thread. @return frames taken.
    std::size_t write(std::span<const float> from) noexcept {
        const std::size_t at = written_.load(std::memory_order_relaxed);
        const std::size_t room = capacity_ - (at - read_.load(std::memory_order_acquire));
        const std::size_t frames = std::min(room, from.size() / channels_);
        const std::size_t first = std::min(frames, capacity_ - index(at));
        std::copy_n(from.data(), first * channels_, &sample_[index(at) * channels_]);
        std::copy_n(from.data() + first * channels_, (frames - first) * channels_, sample_.data());
        written_.store(at + frames, std::memory_order_release);
        return frames;
    }

    /// Reading thread. @return frames given.
    std::size_t read(std::span<float> to) noexcept {
        const std::size_t at = read_.load(std::memory_order_relaxed);
        const std::size_t ready = written_.load(std::memory_order_acquire) - at;
        const std::size_t frames = std::min(ready, to.size() / channels_);
        const std::size_t first = std::min(frames, capacity_ - index(at));
        std::copy_n(&sample_[index(at) * channels_], first * channels_, to.data());
        std::copy_n(sample_.data(), (frames - first) * channels_, to.data() + first * channels_);
        read_.store(at + frames, std::memory_order_release);
        return frames;
    }

private:
    std::size_t index(std::size_t at) const noexcept { return at & (capacity_ - 1); }

    std::size_t channels_;
    std::size_t capacity_; ///< [frames], a power of two
    std::vector<float> sample_;
    // One cache line each, or the two threads would slow each other down.
    alignas(64) std::atomic<std::size_t> written_{0};
    alignas(64) std::atomic<std::size_t> read_{0};
};

} // namespace ode::sound
