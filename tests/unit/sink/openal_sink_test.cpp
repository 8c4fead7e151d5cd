#include "loopback.h"
#include "signals.h"
#include "sink/openal_sink.h"

#include <AL/al.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

namespace ode::sound {
namespace {

using Clock = std::chrono::steady_clock;

// The application owns a context, on the process and on its thread. Ours comes, plays and goes.
TEST(OpenAlSink, LeavesTheApplicationsContextAlone) {
    const auto open_loopback = reinterpret_cast<LPALCLOOPBACKOPENDEVICESOFT>(
        alcGetProcAddress(nullptr, "alcLoopbackOpenDeviceSOFT"));
    ALCdevice* device = open_loopback(nullptr);
    ASSERT_NE(device, nullptr);
    const auto get_thread_context = reinterpret_cast<PFNALCGETTHREADCONTEXTPROC>(
        alcGetProcAddress(device, "alcGetThreadContext"));
    const auto set_thread_context = reinterpret_cast<PFNALCSETTHREADCONTEXTPROC>(
        alcGetProcAddress(device, "alcSetThreadContext"));
    const ALCint attributes[] = {ALC_FORMAT_CHANNELS_SOFT,
                                 ALC_STEREO_SOFT,
                                 ALC_FORMAT_TYPE_SOFT,
                                 ALC_FLOAT_SOFT,
                                 ALC_FREQUENCY,
                                 44100,
                                 0};
    ALCcontext* context = alcCreateContext(device, attributes);
    ALCcontext* of_thread = alcCreateContext(device, attributes);
    ASSERT_TRUE(context && of_thread);
    for (const bool with_thread_context : {false, true}) {
        alcMakeContextCurrent(context);
        ALCcontext* const expected = with_thread_context ? of_thread : nullptr;
        set_thread_context(expected);
        ALuint source = 0;
        alGenSources(1, &source);
        {
            test::Loopback loopback;
            OpenAlSink sink(loopback.device());
            const auto untouched = [&](const char* when) {
                EXPECT_EQ(get_thread_context(), expected) << when;
                set_thread_context(nullptr);
                EXPECT_EQ(alcGetCurrentContext(), context) << when;
                set_thread_context(expected);
                EXPECT_TRUE(alIsSource(source)) << when;
                EXPECT_EQ(alGetError(), AL_NO_ERROR) << when;
            };
            ASSERT_TRUE(sink.open({48000, 2}));
            untouched("after open");
            sink.write(test::noise(2 * 5000));
            untouched("after write");
            sink.close();
            untouched("after close");
        }
        EXPECT_TRUE(alIsSource(source)) << "after the sink's end";
        alDeleteSources(1, &source);
        set_thread_context(nullptr);
        alcMakeContextCurrent(nullptr);
    }
    alcDestroyContext(of_thread);
    alcDestroyContext(context);
    alcCloseDevice(device);
}

// The sink plays in the application's own context: what comes out is the stream bit for bit, beside
// the application's source, and nothing of the application's is changed, not even its error flag.
TEST(OpenAlSink, PlaysInTheApplicationsContext) {
    const auto open_loopback = reinterpret_cast<LPALCLOOPBACKOPENDEVICESOFT>(
        alcGetProcAddress(nullptr, "alcLoopbackOpenDeviceSOFT"));
    const auto render = reinterpret_cast<LPALCRENDERSAMPLESSOFT>(
        alcGetProcAddress(nullptr, "alcRenderSamplesSOFT"));
    ALCdevice* device = open_loopback(nullptr);
    ASSERT_NE(device, nullptr);
    EXPECT_THROW(OpenAlDevice::of_application(), Refused) << "nothing is current";
    const ALCint attributes[] = {ALC_FORMAT_CHANNELS_SOFT, ALC_STEREO_SOFT, ALC_FORMAT_TYPE_SOFT,
                                 ALC_FLOAT_SOFT,           ALC_FREQUENCY,   48000,
                                 ALC_OUTPUT_LIMITER_SOFT,  ALC_FALSE,       0};
    ALCcontext* context = alcCreateContext(device, attributes);
    ASSERT_NE(context, nullptr);
    alcMakeContextCurrent(context);
    alDistanceModel(AL_EXPONENT_DISTANCE);
    ALuint own = 0;
    alGenSources(1, &own);
    alSourcef(own, AL_GAIN, -1); // an error that the application has yet to read
    const std::vector<float> stream = test::noise(2 * 4000);
    std::vector<float> heard(2 * 8000);
    {
        OpenAlDevice borrowed = OpenAlDevice::of_application();
        borrowed.loopback = true;
        OpenAlSink sink(std::move(borrowed));
        ASSERT_TRUE(sink.open({48000, 2})) << sink.error();
        EXPECT_EQ(alcGetCurrentContext(), context);
        EXPECT_EQ(alGetError(), static_cast<ALenum>(AL_INVALID_VALUE)) << "the application's own";
        EXPECT_EQ(alGetInteger(AL_DISTANCE_MODEL), AL_EXPONENT_DISTANCE);
        sink.write(stream);
        for (std::size_t f = 0; f < 8000; f += 100) {
            render(device, &heard[2 * f], 100);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        std::thread closing([&] { sink.close(); });
        std::vector<float> rest(200);
        for (int i = 0; i < 100; ++i) {
            render(device, rest.data(), 100);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        closing.join();
    }
    const auto first = std::find_if(heard.begin(), heard.end(), [](float s) { return s != 0.0F; });
    ASSERT_GE(std::distance(first, heard.end()), 3000);
    EXPECT_TRUE(std::equal(stream.begin(), stream.begin() + 3000, first));
    EXPECT_EQ(alcGetCurrentContext(), context);
    EXPECT_EQ(alcGetContextsDevice(context), device) << "not closed";
    EXPECT_TRUE(alIsSource(own));
    alDeleteSources(1, &own);
    alcMakeContextCurrent(nullptr);
    alcDestroyContext(context);
    EXPECT_TRUE(alcCloseDevice(device));
}

// The cable is pulled: frames pass by unheard, and when a device is there again sound goes on.
TEST(OpenAlSink, LostDeviceIsWaitedFor) {
    test::Loopback first, second;
    std::atomic<bool> there{true}, second_there{false};
    OpenAlDevice device = first.device();
    device.connected = [&] { return there.load(); };
    OpenAlSink sink(
        std::move(device), [](const char*) {},
        [&] {
            if (!second_there)
                throw Refused("no device");
            OpenAlDevice other = second.device();
            other.connected = [] { return true; };
            return other;
        });
    ASSERT_TRUE(sink.open({48000, 2}));
    std::vector<float> heard;
    const auto live = [&](test::Loopback* device_now, double seconds) { // at real time's pace
        const auto end = Clock::now() + std::chrono::duration<double>(seconds);
        while (Clock::now() < end) {
            EXPECT_EQ(sink.write(std::vector<float>(2 * 480, 0.25F)), 480u);
            if (device_now)
                device_now->render(480, heard);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    };
    live(&first, 0.3);
    EXPECT_FLOAT_EQ(heard.back(), 0.25F);
    there = false;
    live(nullptr, 1.2);
    EXPECT_EQ(sink.lost_devices(), 1u);
    EXPECT_LT(sink.backlog(), 48000u / 2) << "what nobody hears does not pile up";
    EXPECT_THAT(sink.error(), testing::HasSubstr("disconnected"));
    second_there = true;
    live(nullptr, 0.7);
    heard.clear();
    live(&second, 0.5);
    EXPECT_FLOAT_EQ(heard.back(), 0.25F);
    std::thread drain([&] { // close() plays out what is queued
        for (int i = 0; i < 400; ++i) {
            second.render(480, heard);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    });
    drain.join();
    sink.close();
}

// Nobody renders, so that nothing drains: the simulation is ahead without bound.
TEST(OpenAlSink, SimulationFarAheadIsToldAndNeverWaits) {
    test::Loopback loopback;
    OpenAlSink sink(loopback.device());
    ASSERT_TRUE(sink.open({8000, 1}));
    const std::vector<float> second(8000, 0.25F);
    std::size_t offered = 0;
    std::size_t taken = 0;
    for (; offered < 30 * second.size(); offered += second.size()) {
        taken += sink.write(second);
        EXPECT_EQ(sink.backlog(), taken);
    }
    EXPECT_GE(taken, 10 * second.size());
    EXPECT_LT(taken, offered);
    EXPECT_THAT(sink.error(), testing::AllOf(testing::HasSubstr("10 s ahead"),
                                             testing::HasSubstr("dSoundSinkGetBacklog")));
    sink.close(); // gives up on a device that takes nothing
}

TEST(OpenAlSink, FormatItCannotPlayIsToldAndForgotten) {
    test::Loopback loopback;
    OpenAlSink sink(loopback.device());
    EXPECT_FALSE(sink.open({48000, 6}));
    EXPECT_THAT(sink.error(), testing::HasSubstr("not 6"));
    EXPECT_EQ(sink.write(std::vector<float>(60)), 10U);
    EXPECT_EQ(sink.backlog(), 0U);
}

// In a process of its own, since OpenAL reads ALSOFT_DRIVERS once. The null back end keeps a sound
// card's time: it cannot play half a second in less, and how much more depends on the machine.
[[noreturn]] void play_half_a_second_on_null_driver() {
    setenv("ALSOFT_DRIVERS", "null", 1);
    OpenAlSink sink(OpenAlDevice::open_default());
    if (!sink.open({48000, 2}))
        std::exit(1);
    const auto x = test::noise(2 * 24'000);
    const auto start = Clock::now();
    if (sink.write(x) != 24'000 || sink.backlog() == 0)
        std::exit(2);
    while (sink.backlog() > 0) {
        if (Clock::now() - start > std::chrono::seconds(20))
            std::exit(3);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    // The device mixes up to its own buffer ahead: three periods of 1024 frames by default, 64 ms.
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    if (elapsed.count() < 0.5 - 0.1)
        std::exit(4);
    sink.close();
    std::exit(*sink.error() == '\0' ? 0 : 5);
}

TEST(OpenAlSinkDeathTest, NullBackEndPlaysInRealTime) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(play_half_a_second_on_null_driver(), testing::ExitedWithCode(0), "");
}

[[noreturn]] void close_plays_out_on_null_driver() {
    setenv("ALSOFT_DRIVERS", "null", 1);
    OpenAlSink sink(OpenAlDevice::open_default());
    if (!sink.open({48000, 2}))
        std::exit(1);
    sink.write(test::noise(2 * 12'000));
    const auto start = Clock::now();
    sink.close();
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    std::exit(elapsed.count() > 0.25 - 0.1 ? 0 : 2);
}

TEST(OpenAlSinkDeathTest, CloseWaitsUntilAllIsPlayed) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(close_plays_out_on_null_driver(), testing::ExitedWithCode(0), "");
}

} // namespace
} // namespace ode::sound
