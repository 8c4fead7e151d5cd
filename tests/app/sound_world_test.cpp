// A body strikes, rings and is heard, through the public functions alone.
#include "support/ode_app.h"
#include "unit/sink/read_sound.h"
#include "unit/sink/scratch.h"

#include <ode_sound/sound.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <vector>

namespace {

using namespace ode;

constexpr dReal kStep = 1.0 / 480; // [s]
constexpr int kRate = 48000;

/// OpenAL reads this once, at its first use: a device that takes sound in real time and is silent.
const int driver = setenv("ALSOFT_DRIVERS", "null", 1);

/// Steel bar of 20 cm, tilted a little, that falls on a plane end first. Without gravity: it
/// strikes a few times within 50 ms, leaves, and rings.
struct Strike : test::OdeApp {
    Strike() : soft(dSoftWorldCreate(world, space)) {
        dCreatePlane(space, 0, 0, 1, 0);
        soft::MeshHandle mesh(dSoftMeshCreateBox(0.2, 0.03, 0.02, 10, 1, 1));
        dSoftSolid steel = dSoftSolidDefault();
        steel.alpha = 0;
        steel.beta = 1e-8; // the lowest mode decays within seconds
        body = dSoftBodyCreate(soft, mesh, &steel);
        const dQuaternion tilt = {std::cos(0.01), 0, std::sin(0.01), 0};
        dSoftBodyRotate(body, tilt);
        dSoftBodySetPosition(body, 0, 0, 0.0122); // the lower end is 0.2 mm above the plane
        dSoftBodySetLinearVel(body, 0, 0, -0.1);
    }

    void run(double seconds) {
        for (long i = std::lround(seconds / kStep); i > 0; --i)
            step(kStep);
    }

    soft::WorldHandle soft;
    dSoftBodyID body;
};

std::vector<float> samples_of(dSoundSinkID sink) {
    const float* first = nullptr;
    int channels = 0;
    const unsigned long frames = dSoundSinkGetSamples(sink, &first, &channels);
    return {first, first + frames * static_cast<unsigned long>(channels)};
}

dSoundStats stats_of(dSoundWorldID world) {
    dSoundStats stats{};
    stats.struct_size = sizeof stats;
    dSoundGetStats(world, &stats);
    return stats;
}

bool sounds(const std::vector<float>& samples) {
    return std::ranges::any_of(samples, [](float s) { return s != 0; }) &&
           std::ranges::all_of(samples, [](float s) { return std::isfinite(s); });
}

std::vector<float> record(double seconds) {
    Strike app;
    sound::WorldHandle world(dSoundWorldCreate(app.soft));
    dSoundListenerID ears = dSoundListenerCreate(world);
    dSoundListenerSetPosition(ears, 0, -1, 0);
    sound::SinkHandle memory(dSoundSinkCreateMemory());
    dSoundListenerAddSink(ears, memory);
    app.run(seconds);
    return samples_of(memory);
}

// The device's own bits are compared in tests/unit/sink/same_samples_test.cpp, where OpenAL's
// loopback stands for it; here all four take the same stream without one holding up another.
TEST(SoundWorld, FourSinksOfOneListenerReceiveTheSameSamples) {
    const sound::test::Scratch scratch;
    Strike app;
    sound::WorldHandle world(dSoundWorldCreate(app.soft));
    dSoundListenerID ears = dSoundListenerCreate(world);
    dSoundListenerSetPosition(ears, 0.1, -1, 0);
    sound::SinkHandle null(dSoundSinkCreateNull());
    sound::SinkHandle memory(dSoundSinkCreateMemory());
    sound::SinkHandle file(dSoundSinkCreateFile(scratch.file("four.wav").c_str()));
    sound::SinkHandle live(dSoundSinkCreateOpenAL());
    ASSERT_STREQ(dSoundSinkGetKind(live), "openal");
    for (dSoundSinkID sink : {null.get(), memory.get(), file.get(), live.get()})
        ASSERT_EQ(dSoundListenerAddSink(ears, sink), 1) << dSoundSinkGetKind(sink);
    app.run(0.05);
    EXPECT_LE(dSoundSinkGetBacklog(live), stats_of(world).frames);
    world.reset(); // plays out
    for (dSoundSinkID sink : {null.get(), memory.get(), file.get(), live.get()})
        EXPECT_STREQ(dSoundSinkGetError(sink), "") << dSoundSinkGetKind(sink);
    EXPECT_EQ(dSoundSinkGetBacklog(live), 0U) << "closed: all has been played";
    const std::vector<float> kept = samples_of(memory);
    EXPECT_TRUE(sounds(kept));
    EXPECT_GT(kept.size(), 2 * 0.05 * kRate);
    const sound::test::ReadSound read(scratch.file("four.wav"));
    EXPECT_EQ(read.info.samplerate, kRate);
    EXPECT_EQ(read.info.channels, 2);
    EXPECT_EQ(read.sample, kept);
}

// A microphone beside two ears that are no distance apart hears what each of them hears, and writes
// it in three forms at once.
TEST(SoundWorld, OneEarHearsWhatTwoInOnePlaceHear) {
    const sound::test::Scratch scratch;
    Strike app;
    sound::WorldHandle world(dSoundWorldCreate(app.soft));
    dSoundListenerID ears = dSoundListenerCreate(world);
    dSoundListenerID microphone = dSoundListenerCreate(world);
    EXPECT_EQ(dSoundListenerSetEars(microphone, 3), 0);
    ASSERT_EQ(dSoundListenerSetEars(microphone, 1), 1);
    for (dSoundListenerID listener : {ears, microphone}) {
        dSoundListenerSetPosition(listener, 0.1, -1, 0);
        dSoundListenerSetEarDistance(listener, listener == ears ? 0 : 0.4);
    }
    sound::SinkHandle two(dSoundSinkCreateMemory()), one(dSoundSinkCreateMemory());
    dSoundFile small = dSoundFileDefault();
    small.bits = 16;
    sound::SinkHandle wav(dSoundSinkCreateFileAs(scratch.file("one.wav").c_str(), &small));
    sound::SinkHandle flac(dSoundSinkCreateFile(scratch.file("one.flac").c_str()));
    dSoundListenerAddSink(ears, two);
    for (dSoundSinkID sink : {one.get(), wav.get(), flac.get()})
        ASSERT_EQ(dSoundListenerAddSink(microphone, sink), 1);
    EXPECT_EQ(dSoundListenerSetEars(microphone, 2), 0) << "sinks have been told";
    app.run(0.05);
    dSoundLevel level{};
    level.struct_size = sizeof level;
    dSoundListenerGetLevel(microphone, &level);
    EXPECT_GT(level.peak[0], 0);
    EXPECT_EQ(level.peak[1], 0);
    world.reset();
    const std::vector<float> stereo = samples_of(two), mono = samples_of(one);
    ASSERT_EQ(stereo.size(), 2 * mono.size());
    EXPECT_TRUE(sounds(mono));
    for (std::size_t i = 0; i < mono.size(); ++i) {
        ASSERT_EQ(stereo[2 * i], mono[i]) << i;
        ASSERT_EQ(stereo[2 * i + 1], mono[i]) << i;
    }
    const struct {
        const char* name;
        double step; // of a sample
    } forms[] = {{"one.wav", 1.0 / 32768}, {"one.flac", 1.0 / 8388608}};
    for (const auto& form : forms) {
        const sound::test::ReadSound read(scratch.file(form.name));
        EXPECT_EQ(read.info.channels, 1);
        ASSERT_EQ(read.sample.size(), mono.size());
        for (std::size_t i = 0; i < mono.size(); ++i) // dithered by up to one step
            ASSERT_NEAR(read.sample[i], mono[i], 2 * form.step) << form.name;
    }
}

TEST(SoundWorld, TwoRunsGiveTheSameBits) {
    const std::vector<float> once = record(0.05);
    EXPECT_TRUE(sounds(once));
    EXPECT_EQ(record(0.05), once);
}

TEST(SoundWorld, NobodyListensNothingIsDone) {
    Strike app;
    sound::WorldHandle world(dSoundWorldCreate(app.soft));
    sound::SinkHandle memory(dSoundSinkCreateMemory());
    app.run(0.02);
    EXPECT_EQ(stats_of(world).observed_substeps, 0U);
    EXPECT_EQ(stats_of(world).frames, 0U);
    dSoftWorldStats soft{};
    soft.struct_size = sizeof soft;
    dSoftWorldGetStats(app.soft, &soft);
    EXPECT_GT(soft.substeps, 1000U);
    EXPECT_EQ(soft.observer_calls, 0U);

    dSoundListenerID ears = dSoundListenerCreate(world);
    app.run(0.02);
    dSoundListenerDestroy(ears);
    const unsigned long seen = stats_of(world).observed_substeps;
    EXPECT_GT(seen, 1000U);
    app.run(0.02);
    EXPECT_EQ(stats_of(world).observed_substeps, seen) << "the last listener has gone";
}

/// Level of a Hann-windowed stretch at a frequency, relative.
double level(const std::vector<double>& x, double frequency) {
    const std::complex<double> turn = std::polar(1.0, -2 * std::numbers::pi * frequency / kRate);
    std::complex<double> now = 1;
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i, now *= turn) {
        const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(x.size());
        sum += x[i] * (0.5 - 0.5 * std::cos(2 * std::numbers::pi * u)) * now;
    }
    return std::abs(sum);
}

// After the blows 0.14 s of ringing are left: a line 14 Hz wide, whose summit is found to 0.2 Hz,
// 0.1 cents. The body leaves at right angles to the listener, so there is no Doppler shift, and
// turns at about 1 rad/s: 0.2 Hz. The explicit step itself raises a frequency by (w dt)^2 / 24:
// 0.4 cents of the mode heard, with steps of 2.1 us.
TEST(SoundWorld, PitchIsThatOfThePredictedMode) {
    const std::vector<float> heard = record(0.2);
    std::vector<double> left;
    for (std::size_t i = 2 * kRate / 16; i < heard.size(); i += 2)
        left.push_back(static_cast<double>(heard[i]));
    double summit = 0;
    double highest = 0;
    const auto climb = [&](double from, double to, double by) {
        for (double f = from; f <= to; f += by)
            if (const double l = level(left, f); l > highest) {
                highest = l;
                summit = f;
            }
    };
    climb(200, 8000, 3);
    climb(summit - 3, summit + 3, 0.2);

    Strike app;
    dReal mode[12];
    const int modes = dSoftBodyGetModes(app.body, 12, mode);
    ASSERT_GT(modes, 0);
    const double nearest = *std::min_element(mode, mode + modes, [&](double a, double b) {
        return std::abs(a - summit) < std::abs(b - summit);
    });
    EXPECT_LT(std::abs(1200 * std::log2(summit / nearest)), 3.0)
        << "heard " << summit << " Hz, predicted " << nearest << " Hz";
}

enum End { kSoft, kSound, kBody, kSink, kListener, kEnds };

// Every order of ends, with a step between each two: none may crash, and the sound that was on its
// way when a world ended is in the file.
TEST(SoundWorld, EndsInAnyOrder) {
    const sound::test::Scratch scratch;
    std::vector<int> order(kEnds);
    std::iota(order.begin(), order.end(), 0);
    do {
        Strike app;
        dSoundWorldID world = dSoundWorldCreate(app.soft);
        dSoundListenerID ears = dSoundListenerCreate(world);
        dSoundSinkID file = dSoundSinkCreateFile(scratch.file("end.wav").c_str());
        dSoundListenerAddSink(ears, file);
        app.run(2 * kStep);
        bool soft_alive = true;
        bool sound_alive = true;
        for (const int end : order) {
            if (end == kSoft) {
                app.soft.reset();
                soft_alive = false;
            } else if (end == kSound) {
                dSoundWorldDestroy(world); // and its listeners
                sound_alive = false;
            } else if (end == kBody && soft_alive) { // bodies end with their world
                dSoftBodyDestroy(app.body);
            } else if (end == kSink) {
                dSoundSinkDestroy(file);
            } else if (end == kListener && sound_alive) {
                dSoundListenerDestroy(ears);
            }
            app.step(kStep);
        }
        const sound::test::ReadSound read(scratch.file("end.wav"));
        EXPECT_GE(read.sample.size(), 2 * 2 * kStep * kRate - 2 * 101);
    } while (std::ranges::next_permutation(order).found);
}

/// A program's life without one destroy call. @param end_ode  ODE's world alone is destroyed.
[[noreturn]] void live_and_leave(const std::string& path, bool end_ode) {
    auto* app = new Strike;
    dSoundListenerID ears = dSoundListenerCreate(dSoundWorldCreate(app->soft));
    dSoundListenerSetPosition(ears, 0, -34.3, 0); // 0.1 s away: all that is heard is played out
    dSoundListenerSetSink(ears, dSoundSinkCreateFile(path.c_str()));
    app->run(0.02);
    if (end_ode) {
        dWorldDestroy(app->world);
        dCloseODE();
    }
    std::exit(0);
}

/// In a process of its own; one call a test, since that process runs the test up to the call.
void expect_whole_file(const std::string& path, bool end_ode) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(live_and_leave(path, end_ode), testing::ExitedWithCode(0), "");
    const sound::test::ReadSound read(path);
    EXPECT_GE(read.sample.size(), 2 * 0.12 * kRate - 2 * 2);
    EXPECT_TRUE(sounds(read.sample));
    std::remove(path.c_str());
}

TEST(SoundWorld, FileIsWholeWhenNobodyEndsAnything) {
    expect_whole_file(testing::TempDir() + "nobody_ends.wav", false);
}

TEST(SoundWorld, FileIsWholeWhenOdeAloneIsEnded) {
    expect_whole_file(testing::TempDir() + "ode_ends.wav", true);
}

} // namespace
