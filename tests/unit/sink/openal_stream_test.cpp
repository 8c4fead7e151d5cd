// The way to the device, pumped by the test itself, so that each underrun falls where it is forced.
#include "loopback.h"
#include "signals.h"
#include "sink/openal_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace ode::sound {
namespace {

struct Player {
    explicit Player(int channels = 2, int rate = 48000)
        : ring(1U << 16, channels),
          stream(loopback.device(), {rate, channels}, [this](const char* s) { told += s; }) {}

    void pump(bool ending = false) {
        const OpenAlContext::Scope scope(stream.context());
        stream.pump(ring, ending);
    }
    /// Lets the device play, in pieces that divide no buffer, with the feeder coming after each.
    void play(std::size_t frames, bool ending = false) {
        while (frames > 0) {
            pump(ending);
            const std::size_t piece = std::min<std::size_t>(frames, 100);
            loopback.render(piece, heard);
            frames -= piece;
        }
    }

    std::string told;
    test::Loopback loopback;
    FrameRing ring;
    OpenAlStream stream;
    std::vector<float> heard;
};

TEST(OpenAlStream, PlaysBitForBitAndStopsWhenAllIsOut) {
    Player player;
    const auto x = test::noise(2 * 10'001);
    player.ring.write(x);
    player.play(20'000, true);
    EXPECT_TRUE(player.stream.finished());
    EXPECT_EQ(player.stream.played_frames(), 10'001U);
    EXPECT_TRUE(std::equal(x.begin(), x.end(), player.heard.begin()));
    EXPECT_EQ(player.stream.underruns(), 0U) << "the end is no underrun";
    EXPECT_EQ(player.told, "");
    const auto tail = std::vector<float>(player.heard.begin() + 2 * 15'000, player.heard.end());
    EXPECT_THAT(tail, testing::Each(0.0F));
}

TEST(OpenAlStream, MonoReachesBothChannelsBitForBit) {
    Player player(1);
    const auto x = test::noise(5000);
    player.ring.write(x);
    player.play(5000, true);
    for (std::size_t i = 0; i < x.size(); ++i) {
        ASSERT_EQ(player.heard[2 * i], x[i]) << i;
        ASSERT_EQ(player.heard[2 * i + 1], x[i]) << i;
    }
}

TEST(OpenAlStream, RunsAtTheRateItIsGiven) {
    for (const int rate : {8000, 44100, 96000, 192000}) {
        Player player(2, rate);
        EXPECT_EQ(player.stream.context().rate(), rate);
        EXPECT_EQ(player.told, "");
    }
}

TEST(OpenAlStream, MoreThanTwoChannelsAreRefused) { EXPECT_THROW(Player(4), Refused); }

TEST(OpenAlStream, StartsWhenItsLeadIsThere) {
    Player player;
    const std::size_t lead = player.stream.lead();
    const auto x = test::noise(2 * 2 * lead);
    player.ring.write(std::span(x).first(2 * (lead - 1)));
    player.play(1000);
    EXPECT_THAT(player.heard, testing::Each(0.0F));
    player.ring.write(std::span(x).subspan(2 * (lead - 1)));
    player.heard.clear();
    player.play(lead);
    EXPECT_TRUE(std::equal(player.heard.begin(), player.heard.end(), x.begin()));
    EXPECT_EQ(player.stream.underruns(), 0U);
}

// The producer stalls for long, comes back, stalls briefly. A full-scale constant is the worst case
// for steps; that no step comes from the source stopping shows that it never does.
TEST(OpenAlStream, ForcedUnderrunsAreCountedAndMakeNoStep) {
    Player player;
    const std::vector<float> ones(2 * 20'000, 1.0F);
    player.ring.write(ones);
    player.play(20'000 + 6000);
    EXPECT_EQ(player.stream.underruns(), 1U);
    EXPECT_EQ(player.heard.back(), 0.0F) << "a long gap is silent";
    player.ring.write(ones);
    player.play(20'000 + 300);
    EXPECT_EQ(player.stream.underruns(), 2U);
    player.ring.write(ones);
    player.play(10'000);
    EXPECT_EQ(player.stream.underruns(), 2U);
    EXPECT_EQ(player.heard.back(), 1.0F);
    const std::vector<float> all(player.heard.begin(), player.heard.end());
    EXPECT_LT(test::step(std::vector<float>(all.begin() + 2, all.end())), test::kMinus60dB);
}

TEST(OpenAlStream, ForcedUnderrunOfAToneMakesNoClick) {
    Player player;
    const double omega = test::omega_of(440, 48000);
    const auto x = test::sine(40'000, omega, 0.5);
    player.ring.write(std::span(x).first(2 * 20'000));
    player.play(20'000 + 6000);
    player.ring.write(std::span(x).last(2 * 20'000));
    player.play(10'000);
    EXPECT_EQ(player.stream.underruns(), 1U);
    EXPECT_LT(test::click(player.heard, omega), test::kMinus60dB);
}

TEST(OpenAlStream, SimulationSlowerThanRealTimeLosesNothing) {
    Player player;
    const auto x = test::noise(2 * 30'000);
    std::size_t at = 0;
    while (player.stream.played_frames() < 29'000 && player.heard.size() < 2 * 200'000) {
        at += 2 * player.ring.write(
                      std::span(x).subspan(at, std::min<std::size_t>(x.size() - at, 2 * 400)));
        player.play(800);
    }
    EXPECT_GE(player.stream.played_frames(), 29'000U);
    EXPECT_GT(player.stream.underruns(), 1U);
}

// All that is written is with the device at once, so that the feeder may stay away for as long,
// less what the device may be taking.
TEST(OpenAlStream, FeederMayBeLateByAllThatIsWritten) {
    Player player;
    const auto x = test::noise(2 * 4000);
    player.ring.write(std::span(x).first(2 * 2000));
    player.play(300);
    player.loopback.render(1600, player.heard); // without pump
    player.ring.write(std::span(x).last(2 * 2000));
    player.play(1600);
    EXPECT_EQ(player.stream.underruns(), 0U);
    EXPECT_TRUE(std::equal(player.heard.begin(), player.heard.end(), x.begin()));
}

// A feeder that stays away after the stream got short: the device has the bridge already.
TEST(OpenAlStream, DeviceFadesWhereTheFeederStaysAway) {
    Player player;
    const std::vector<float> ones(2 * 20'000, 1.0F);
    player.ring.write(ones);
    player.play(20'000 - 300);
    player.loopback.render(5000, player.heard); // without pump
    EXPECT_EQ(player.heard.back(), 0.0F);
    player.ring.write(ones);
    player.play(15'000);
    EXPECT_EQ(player.heard.back(), 1.0F);
    EXPECT_EQ(player.stream.underruns(), 1U);
    EXPECT_LT(test::step(std::vector<float>(player.heard.begin() + 2, player.heard.end())),
              test::kMinus60dB);
}

// Later still, with much written when it left: the device comes to the end with a step that nobody
// can undo. It is counted, the stream goes on fading in, and nothing is heard twice within the
// device's memory of 32768 frames.
TEST(OpenAlStream, LateFeederIsCountedAndPlaysNothingTwice) {
    for (const std::size_t away : {12'000U, 30'000U}) {
        Player player;
        const std::vector<float> ones(2 * 5000, 1.0F);
        player.ring.write(ones);
        player.play(100);
        player.loopback.render(away, player.heard); // without pump
        EXPECT_EQ(player.heard.back(), 0.0F);
        const auto first_zero = std::find(player.heard.begin(), player.heard.end(), 0.0F);
        EXPECT_EQ(first_zero - player.heard.begin(), 2 * 5000);
        EXPECT_THAT(std::vector<float>(first_zero, player.heard.end()), testing::Each(0.0F));
        player.ring.write(ones);
        player.pump();
        EXPECT_EQ(player.stream.underruns(), 1U);
        EXPECT_LT(player.stream.played_frames(), 5001U);
        const auto resumed = player.heard.size();
        player.play(4000);
        const std::vector<float> after(
            player.heard.begin() + static_cast<std::ptrdiff_t>(resumed) - 2, player.heard.end());
        EXPECT_LT(test::step(after), test::kMinus60dB);
        EXPECT_EQ(after.back(), 1.0F);
        EXPECT_EQ(player.stream.underruns(), 1U);
    }
}

TEST(ToInt16, RoundsClipsAndSilencesNan) {
    const std::array<float, 7> x{
        0.0F, 1.0F, -1.0F, 2.0F, -2.0F, 1.6F / 32767, std::numeric_limits<float>::quiet_NaN()};
    std::array<short, 7> y{};
    to_int16(x, y);
    EXPECT_THAT(y, testing::ElementsAre(0, 32767, -32767, 32767, -32768, 2, 0));
}

} // namespace
} // namespace ode::sound
