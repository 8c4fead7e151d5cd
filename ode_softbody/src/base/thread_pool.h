#pragma once

#include "base/tasks.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace ode::soft {

/// Threads that take pieces as they come. A substep has only microseconds of work between two
/// joins, so that idle threads look for the next piece for a while before they sleep; whoever joins
/// does pieces itself, and waits for nobody but a thread amidst one.
class ThreadPool final : public Tasks {
public:
    /// @param threads  the caller's included. @throws std::system_error when there are none to
    /// have.
    explicit ThreadPool(int threads);
    ~ThreadPool() override;

    void run(Piece piece, void* context, std::size_t count) noexcept override;
    int threads() const noexcept override { return static_cast<int>(worker_.size()) + 1; }

private:
    void work() noexcept;
    /// @return whether there was a piece to take.
    bool take_piece() noexcept;
    void stop() noexcept;

    // One at a time, written while nobody has a piece of it.
    Piece piece_ = nullptr;
    void* context_ = nullptr;

    // Pieces not yet taken. Whoever takes one may read the job: it can't end before that piece is
    // done. So no count of jobs is needed to tell a late thread from one in time.
    alignas(64) std::atomic<std::size_t> left_{0};
    alignas(64) std::atomic<std::size_t> undone_{0};
    alignas(64) std::atomic<std::uint32_t> rung_{0}; ///< changes when sleepers are called
    std::atomic<int> sleepers_{0};
    std::atomic<bool> ending_{false};
    std::vector<std::thread> worker_;
};

} // namespace ode::soft
