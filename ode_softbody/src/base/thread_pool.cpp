#include "base/thread_pool.h"

#include <algorithm>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace ode::soft {
namespace {

// About 50 us of looking: longer than what lies between two joins of a substep, shorter than what
// an application does between steps.
constexpr int kLooks = 2000;
// Then a join lets others have the core: the thread that it waits for may be among them.
constexpr int kPatience = 4000;

constexpr std::uint64_t kNext = std::uint64_t{1} << 32; ///< of a stretch's first piece
constexpr std::uint64_t kEnd = kNext - 1;

void pause() noexcept {
#if defined(__SSE__)
    _mm_pause();
#endif
}

} // namespace

ThreadPool::ThreadPool(int threads) : stretch_(static_cast<std::size_t>(threads)) {
    try {
        for (std::size_t i = 1; i < stretch_.size(); ++i)
            worker_.emplace_back([this, i] { work(i); });
    } catch (...) {
        stop();
        throw;
    }
}

ThreadPool::~ThreadPool() { stop(); }

void ThreadPool::stop() noexcept {
    ending_ = true;
    ++rung_;
    rung_.notify_all();
    for (std::thread& worker : worker_)
        worker.join();
}

void ThreadPool::run(Piece piece, void* context, std::size_t count) noexcept {
    piece_ = piece;
    context_ = context;
    undone_.store(count, std::memory_order_relaxed);
    for (std::size_t i = 0; i < stretch_.size(); ++i) {
        const std::uint64_t first = count * i / stretch_.size();
        const std::uint64_t end = count * (i + 1) / stretch_.size();
        stretch_[i].left.store(first << 32 | end);
    }
    // After the pieces: who goes to sleep does it the other way round.
    if (sleepers_.load() != 0) {
        ++rung_;
        rung_.notify_all();
    }
    while (take_piece(0))
        ;
    for (int i = 0; undone_.load(std::memory_order_acquire) != 0; ++i)
        if (i < kPatience)
            pause();
        else
            std::this_thread::yield();
}

bool ThreadPool::take_piece(std::size_t thread) noexcept {
    for (std::size_t i = 0; i < stretch_.size(); ++i) {
        std::atomic<std::uint64_t>& left = stretch_[(thread + i) % stretch_.size()].left;
        std::uint64_t now = left.load(std::memory_order_acquire);
        while ((now >> 32) < (now & kEnd)) {
            const bool own = i == 0;
            const std::uint64_t then = own ? now + kNext : now - 1;
            if (!left.compare_exchange_weak(now, then, std::memory_order_acq_rel,
                                            std::memory_order_acquire))
                continue;
            piece_(context_, own ? now >> 32 : then & kEnd);
            undone_.fetch_sub(1, std::memory_order_release);
            return true;
        }
    }
    return false;
}

bool ThreadPool::any_left() const noexcept {
    return std::any_of(stretch_.begin(), stretch_.end(), [](const Stretch& stretch) {
        const std::uint64_t now = stretch.left.load();
        return (now >> 32) < (now & kEnd);
    });
}

void ThreadPool::work(std::size_t thread) noexcept {
    for (int idle = 0;;) {
        if (take_piece(thread)) {
            idle = 0;
            continue;
        }
        if (ending_.load(std::memory_order_relaxed))
            return;
        if (++idle < kLooks) {
            pause();
            continue;
        }
        const std::uint32_t rung = rung_.load();
        ++sleepers_;
        if (!any_left() && !ending_)
            rung_.wait(rung);
        --sleepers_;
        idle = 0;
    }
}

} // namespace ode::soft
