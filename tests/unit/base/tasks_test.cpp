#include "base/thread_pool.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace ode::soft {
namespace {

class Pool : public testing::TestWithParam<int> {};

// Thousands of joins, some while all threads look, some while they sleep.
TEST_P(Pool, DoesEveryPieceOnce) {
    ThreadPool pool(GetParam());
    EXPECT_EQ(pool.threads(), GetParam());
    const TasksScope scope(&pool);
    std::vector<int> done(100);
    for (int round = 0; round < 5000; ++round) {
        if (round % 1000 == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        const auto count = static_cast<std::size_t>(round * 7 % 100);
        in_pieces(count, [&](std::size_t i) { ++done[i]; });
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(std::exchange(done[i], 0), 1) << "piece " << i << " of round " << round;
    }
}
INSTANTIATE_TEST_SUITE_P(Threads, Pool, testing::Values(1, 2, 3, 8));

TEST(Tasks, RangesCoverAllOnce) {
    ThreadPool pool(3);
    const TasksScope scope(&pool);
    for (const std::size_t size : {0, 1, 99, 100, 199, 200, 12345}) {
        std::vector<int> done(size);
        in_ranges(size, 100, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                ++done[i];
        });
        EXPECT_EQ(done, std::vector<int>(size, 1));
    }
}

TEST(Tasks, APieceOfAPieceIsDoneByItsThread) {
    ThreadPool pool(3);
    const TasksScope scope(&pool);
    std::vector<int> own(12);
    in_pieces(own.size(), [&](std::size_t i) {
        const auto thread = std::this_thread::get_id();
        in_pieces(5, [&](std::size_t) { own[i] += std::this_thread::get_id() == thread; });
    });
    EXPECT_EQ(own, std::vector<int>(12, 5));
    EXPECT_EQ(Tasks::current(), &pool);
}

#if defined(__SSE__)
// An audio thread flushes denormal numbers to zero; a pool that was made before must do so too.
TEST(Tasks, RoundAsTheCallerDoes) {
    constexpr unsigned kFlushToZero = 0x8000;
    ThreadPool pool(4);
    const TasksScope scope(&pool);
    const volatile double smallest_normal = 2.2250738585072014e-308;
    const auto halves = [&] {
        std::vector<double> half(64);
        in_pieces(half.size(), [&](std::size_t i) { half[i] = smallest_normal / 2; });
        return std::accumulate(half.begin(), half.end(), 0.0);
    };
    EXPECT_GT(halves(), 0);
    _mm_setcsr(_mm_getcsr() | kFlushToZero);
    EXPECT_EQ(halves(), 0);
    _mm_setcsr(_mm_getcsr() & ~kFlushToZero);
    EXPECT_GT(halves(), 0);
}
#endif

} // namespace
} // namespace ode::soft
