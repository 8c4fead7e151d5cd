#include "signals.h"
#include "sink/frame_ring.h"

#include <gtest/gtest.h>
#include <thread>

namespace ode::sound {
namespace {

TEST(FrameRing, TakesWhatFitsInWholeFrames) {
    FrameRing ring(8, 2);
    const auto x = test::noise(2 * 20);
    EXPECT_EQ(ring.write(std::span(x).first(2 * 5)), 5U);
    EXPECT_EQ(ring.write(std::span(x).subspan(2 * 5)), 3U);
    EXPECT_EQ(ring.write(std::span(x).subspan(2 * 8)), 0U);
    std::vector<float> y(2 * 20);
    EXPECT_EQ(ring.read(y), 8U);
    EXPECT_TRUE(std::equal(y.begin(), y.begin() + 16, x.begin()));
    EXPECT_EQ(ring.read(y), 0U);
}

// Odd block lengths on both sides cross the wrap at every offset; the thread sanitizer watches.
TEST(FrameRing, CarriesAStreamBetweenThreadsInOrder) {
    FrameRing ring(64, 2);
    const auto x = test::noise(2 * 100'000);
    std::thread writer([&] {
        for (std::size_t at = 0; at < x.size();) {
            const auto rest = std::span(x).subspan(at);
            const std::size_t taken =
                2 * ring.write(rest.first(std::min<std::size_t>(rest.size(), 2 * 37)));
            at += taken;
            if (taken == 0)
                std::this_thread::yield();
        }
    });
    std::vector<float> y;
    std::vector<float> block(2 * 23);
    while (y.size() < x.size()) {
        const std::size_t got = 2 * ring.read(block);
        y.insert(y.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(got));
        if (got == 0)
            std::this_thread::yield();
    }
    writer.join();
    EXPECT_EQ(x, y);
}

} // namespace
} // namespace ode::sound
