#include "loopback.h"
#include "read_sound.h"
#include "scratch.h"
#include "signals.h"
#include "sink/file_sink.h"
#include "sink/memory_sink.h"
#include "sink/null_sink.h"
#include "sink/openal_sink.h"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

namespace ode::sound {
namespace {

using namespace std::chrono_literals;

// All four kinds get the same writes. The OpenAL one plays through OpenAL Soft's own mixer, from
// the sink's own thread; the test takes a buffer's length whenever the feeder has refilled the
// queue.
TEST(Sinks, ReceiveTheSameBits) {
    constexpr std::size_t kFrames = 256 * 150;
    const auto x = test::noise(2 * kFrames);
    const test::Scratch scratch;
    test::Loopback loopback;
    NullSink null;
    MemorySink memory;
    FileSink file(scratch.file("same.wav"));
    OpenAlSink live(loopback.device());
    for (Sink* sink : std::initializer_list<Sink*>{&null, &memory, &file, &live}) {
        ASSERT_TRUE(sink->open({48000, 2})) << sink->error();
        for (std::size_t at = 0; at < x.size();) { // 801 frames: a step of 1/60 s, roughly
            const auto block =
                std::span(x).subspan(at, std::min<std::size_t>(x.size() - at, 2 * 801));
            const std::size_t taken = sink->write(block);
            ASSERT_EQ(taken, block.size() / 2) << sink->kind();
            at += 2 * taken;
        }
    }
    file.close();
    EXPECT_TRUE(std::ranges::equal(memory.samples(), x));
    EXPECT_EQ(test::ReadSound(scratch.file("same.wav")).sample, x);

    std::vector<float> heard;
    const auto give_up = std::chrono::steady_clock::now() + 20s;
    while (heard.size() < x.size() && std::chrono::steady_clock::now() < give_up) {
        // What the feeder reports as played it has followed; so what is written is with the device.
        if (kFrames - live.backlog() != heard.size() / 2) {
            std::this_thread::sleep_for(1ms);
            continue;
        }
        loopback.render(256, heard);
        if (std::ranges::all_of(heard, [](float sample) { return sample == 0; }))
            heard.clear(); // the feeder's thread has yet to start
        if (heard.size() / 2 == kFrames - 3 * 256) {
            EXPECT_EQ(live.underruns(), 0U) << "before the stream ends";
        }
    }
    EXPECT_EQ(heard, x);
    live.close();
    EXPECT_STREQ(live.error(), "");
}

TEST(Sinks, TakeAndForgetWhatComesAfterClose) {
    const test::Scratch scratch;
    MemorySink memory;
    FileSink file(scratch.file("closed.wav"));
    test::Loopback loopback;
    OpenAlSink live(loopback.device());
    const std::vector<float> x(2 * 100, 0.5F);
    for (Sink* sink : std::initializer_list<Sink*>{&memory, &file, &live}) {
        EXPECT_EQ(sink->write(x), 200U) << "before opening, as mono";
        ASSERT_TRUE(sink->open({48000, 2}));
        sink->close();
        sink->close();
        EXPECT_EQ(sink->write(x), 100U);
        EXPECT_STREQ(sink->error(), "") << sink->kind();
    }
    EXPECT_TRUE(memory.samples().empty());
    EXPECT_TRUE(test::ReadSound(scratch.file("closed.wav")).sample.empty());
}

TEST(Sinks, MemoryRefusesAnotherFormatAndKeepsGoing) {
    MemorySink memory;
    ASSERT_TRUE(memory.open({48000, 2}));
    EXPECT_FALSE(memory.open({48000, 1}));
    EXPECT_STRNE(memory.error(), "");
    EXPECT_EQ(memory.write(std::vector<float>(20, 0.5F)), 10U);
    EXPECT_EQ(memory.samples().size(), 20U);
}

} // namespace
} // namespace ode::sound
