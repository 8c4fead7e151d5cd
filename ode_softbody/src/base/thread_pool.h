#pragma once

#include "base/tasks.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace ode::soft {

/// Threads that do pieces side by side. A substep has only microseconds of work between two joins,
/// so that idle threads look for the next piece for a while before they sleep; whoever joins waits
/// for nobody but a thread amidst a piece.
///
/// Each thread has a stretch of the pieces that is its own, the same from job to job: what they
/// write then stays in its core's cache, where moving it from core to core would cost as much as
/// the work. Who is done takes from the end of other stretches.
class ThreadPool final : public Tasks {
public:
    /// @param threads  the caller's included. @throws std::system_error when there are none to
    /// have.
    explicit ThreadPool(int threads);
    ~ThreadPool() override;

    void run(Piece piece, void* context, std::size_t count) noexcept override;
    int threads() const noexcept override { return static_cast<int>(stretch_.size()); }

private:
    /// Pieces not yet taken: the first in the upper half of the bits, the end in the lower one.
    struct alignas(64) Stretch {
        std::atomic<std::uint64_t> left{0};
    };

    void work(std::size_t thread) noexcept;
    /// @return whether there was a piece to take.
    bool take_piece(std::size_t thread) noexcept;
    bool any_left() const noexcept;
    void stop() noexcept;

    // One job at a time, written while nobody has a piece of it. Whoever takes a piece may read it:
    // it can't end before that piece is done. So a thread that comes late can't mistake it.
    Piece piece_ = nullptr;
    void* context_ = nullptr;
    std::vector<Stretch> stretch_; ///< one a thread, the caller's first
    alignas(64) std::atomic<std::size_t> undone_{0};
    alignas(64) std::atomic<std::uint32_t> rung_{0}; ///< changes when sleepers are called
    std::atomic<int> sleepers_{0};
    std::atomic<bool> ending_{false};
    std::vector<std::thread> worker_;
};

} // namespace ode::soft
