#include "base/thread_pool.h"

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

void pause() noexcept {
#if defined(__SSE__)
    _mm_pause();
#endif
}

} // namespace

ThreadPool::ThreadPool(int threads) {
    try {
        for (int i = 1; i < threads; ++i)
            worker_.emplace_back([this] { work(); });
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
    left_.store(count); // before sleepers_ is read: who goes to sleep does it the other way round
    if (sleepers_.load() != 0) {
        ++rung_;
        rung_.notify_all();
    }
    while (take_piece())
        ;
    for (int i = 0; undone_.load(std::memory_order_acquire) != 0; ++i)
        if (i < kPatience)
            pause();
        else
            std::this_thread::yield();
}

bool ThreadPool::take_piece() noexcept {
    std::size_t left = left_.load(std::memory_order_acquire);
    do {
        if (left == 0)
            return false;
    } while (!left_.compare_exchange_weak(left, left - 1, std::memory_order_acq_rel,
                                          std::memory_order_acquire));
    piece_(context_, left - 1);
    undone_.fetch_sub(1, std::memory_order_release);
    return true;
}

void ThreadPool::work() noexcept {
    for (int idle = 0;;) {
        if (take_piece()) {
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
        if (left_.load() == 0 && !ending_)
            rung_.wait(rung);
        --sleepers_;
        idle = 0;
    }
}

} // namespace ode::soft
