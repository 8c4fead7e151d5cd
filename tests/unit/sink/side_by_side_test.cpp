// Several listeners' streams as the channels of one sink.
#include "signals.h"
#include "sink/memory_sink.h"
#include "sink/side_by_side.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ode::sound {
namespace {

/// Channel `c` of `channels`.
std::vector<float> channel(std::span<const float> all, std::size_t c, std::size_t channels) {
    std::vector<float> one;
    for (std::size_t i = c; i < all.size(); i += channels)
        one.push_back(all[i]);
    return one;
}

TEST(SideBySide, PutsEachPartInItsChannels) {
    const auto whole = std::make_shared<MemorySink>();
    SideBySide joined(whole, {2, 1});
    for (const auto& part : joined.parts())
        ASSERT_TRUE(part->open({48000, part == joined.parts()[0] ? 2 : 1}));
    EXPECT_EQ(whole->format(), (Format{48000, 3}));
    const auto two = test::noise(2 * 5000);
    const auto one = test::sine(2500, 0.1, 0.5); // 5000 samples
    // In blocks of unlike lengths, one part ahead of the other by up to 4500 frames.
    for (std::size_t f = 0; f < 5000; f += 500)
        EXPECT_EQ(joined.parts()[0]->write(std::span(two).subspan(2 * f, 2 * 500)), 500U);
    for (std::size_t f = 0; f < 5000; f += 100)
        EXPECT_EQ(joined.parts()[1]->write(std::span(one).subspan(f, 100)), 100U);
    ASSERT_EQ(whole->samples().size(), 3U * 5000);
    EXPECT_EQ(channel(whole->samples(), 0, 3), channel(two, 0, 2));
    EXPECT_EQ(channel(whole->samples(), 1, 3), channel(two, 1, 2));
    EXPECT_EQ(channel(whole->samples(), 2, 3), one);
}

TEST(SideBySide, PartThatStaysAwayIsSilent) {
    const auto whole = std::make_shared<MemorySink>();
    SideBySide joined(whole, {1, 1});
    for (const auto& part : joined.parts())
        ASSERT_TRUE(part->open({8000, 1}));
    const auto x = test::noise(100'000);
    joined.parts()[1]->write(std::span(x).first(1000));
    for (std::size_t f = 0; f < x.size(); f += 250)
        EXPECT_EQ(joined.parts()[0]->write(std::span(x).subspan(f, 250)), 250U);
    EXPECT_GT(whole->samples().size(), 2 * (x.size() - 17'000)) << "a second or two behind";
    joined.finish();
    EXPECT_EQ(channel(whole->samples(), 0, 2), x);
    const auto other = channel(whole->samples(), 1, 2);
    EXPECT_TRUE(std::equal(x.begin(), x.begin() + 1000, other.begin()));
    EXPECT_THAT(std::vector<float>(other.begin() + 1000, other.end()), testing::Each(0.0F));
}

/// Takes what fits.
class Narrow final : public Sink {
public:
    bool open(const Format&) override { return true; }
    std::size_t write(std::span<const float> x) noexcept override {
        const std::size_t frames = std::min<std::size_t>(x.size() / 2, room);
        got.insert(got.end(), x.begin(), x.begin() + static_cast<std::ptrdiff_t>(2 * frames));
        room -= frames;
        return frames;
    }
    void close() noexcept override {}
    const char* error() const noexcept override { return ""; }
    const char* kind() const noexcept override { return "narrow"; }
    std::size_t room = 0;
    std::vector<float> got;
};

TEST(SideBySide, WaitsForASinkThatIsFullAndLosesNoFrameItTook) {
    const auto whole = std::make_shared<Narrow>();
    SideBySide joined(whole, {1, 1});
    for (const auto& part : joined.parts())
        ASSERT_TRUE(part->open({8000, 1}));
    const auto x = test::noise(60'000);
    std::size_t taken = 0;
    for (std::size_t f = 0; f < x.size(); f += 100) {
        whole->room += 77;
        const auto block = std::span(x).subspan(f, 100);
        const std::size_t now = joined.parts()[0]->write(block);
        EXPECT_EQ(joined.parts()[1]->write(block.first(now)), now);
        taken += now;
        if (now < 100)
            break;
    }
    EXPECT_GT(taken, 8000U);
    whole->room = taken;
    joined.finish();
    ASSERT_EQ(whole->got.size(), 2 * taken);
    for (const std::size_t c : {0U, 1U})
        EXPECT_TRUE(std::ranges::equal(channel(whole->got, c, 2), std::span(x).first(taken)));
}

} // namespace
} // namespace ode::sound
