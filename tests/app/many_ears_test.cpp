// Several listeners in one file of several channels, through the public functions alone.
#include "support/soft_app.h"
#include "unit/sink/read_sound.h"
#include "unit/sink/scratch.h"

#include <ode_sound/sound.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace {

using namespace ode;
using testing::HasSubstr;

/// A steel bar that strikes a floor, and three listeners: two ears, one, two.
struct ManyEars : testing::Test {
    ManyEars() : soft(dSoftWorldCreate(app.world, app.space)) {
        dCreatePlane(app.space, 0, 0, 1, 0);
        soft::MeshHandle mesh(dSoftMeshCreateBox(0.2, 0.03, 0.02, 6, 1, 1));
        const dSoftSolid steel = dSoftSolidDefault();
        const dSoftBodyID body = dSoftBodyCreate(soft, mesh, &steel);
        dSoftBodySetPosition(body, 0, 0, 0.0102);
        dSoftBodySetLinearVel(body, 0, 0, -0.1);
        world = sound::WorldHandle(dSoundWorldCreate(soft));
        for (const double x : {-1.0, 0.0, 1.5}) {
            ears.push_back(dSoundListenerCreate(world));
            dSoundListenerSetPosition(ears.back(), x, -1, 0.2);
        }
        dSoundListenerSetEars(ears[1], 1);
    }

    void run(int steps) {
        for (int i = 0; i < steps; ++i)
            app.step(1.0 / 480);
    }

    const test::Messages messages;
    test::OdeApp app;
    soft::WorldHandle soft;
    sound::WorldHandle world;
    std::vector<dSoundListenerID> ears;
    const sound::test::Scratch scratch;
};

TEST_F(ManyEars, OneFileHoldsWhatEachHears) {
    std::vector<sound::SinkHandle> own;
    for (const dSoundListenerID listener : ears) {
        own.emplace_back(dSoundSinkCreateMemory());
        ASSERT_EQ(dSoundListenerAddSink(listener, own.back()), 1);
    }
    sound::SinkHandle file(dSoundSinkCreateFile(scratch.file("five.wav").c_str()));
    ASSERT_EQ(dSoundListenersAddSink(ears.data(), 3, file), 1) << test::Messages::text();
    run(12);
    world.reset();
    file.reset();
    EXPECT_EQ(test::Messages::text(), "");
    const sound::test::ReadSound read(scratch.file("five.wav"));
    ASSERT_EQ(read.info.channels, 5);
    std::size_t at = 0;
    for (const sound::SinkHandle& memory : own) {
        const float* first = nullptr;
        int channels = 0;
        const unsigned long frames = dSoundSinkGetSamples(memory, &first, &channels);
        ASSERT_GT(frames, 1000UL);
        double loud = 0;
        for (std::size_t f = 0; f < static_cast<std::size_t>(read.info.frames); ++f)
            for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
                const float expected =
                    f < frames ? first[f * static_cast<std::size_t>(channels) + c] : 0.0F;
                ASSERT_EQ(read.sample[5 * f + at + c], expected) << "frame " << f;
                loud = std::max(loud, std::abs(static_cast<double>(expected)));
            }
        EXPECT_GT(loud, 1e-6) << "something is heard";
        at += static_cast<std::size_t>(channels);
    }
}

TEST_F(ManyEars, WhoeverEndsIsSilentAndTheOthersGoOn) {
    sound::SinkHandle memory(dSoundSinkCreateMemory());
    ASSERT_EQ(dSoundListenersAddSink(ears.data(), 2, memory), 1) << test::Messages::text();
    run(4);
    dSoundListenerDestroy(ears[0]);
    run(600); // more than a second
    const float* first = nullptr;
    int channels = 0;
    EXPECT_GT(dSoundSinkGetSamples(memory, &first, &channels), 100UL);
    EXPECT_EQ(channels, 3);
    memory.reset(); // before the listener that has it
    run(1);
    EXPECT_EQ(test::Messages::text(), "");
}

TEST_F(ManyEars, WhatCannotBeIsRefusedInWords) {
    sound::SinkHandle memory(dSoundSinkCreateMemory());
    const dSoundListenerID twice[] = {ears[0], ears[1], ears[0]};
    EXPECT_EQ(dSoundListenersAddSink(twice, 3, memory), 0);
    EXPECT_THAT(test::Messages::text(), HasSubstr("listener 2 is named twice"));
    test::Messages::all().clear();
    EXPECT_EQ(dSoundListenersAddSink(ears.data(), 0, memory), 0);
    EXPECT_THAT(test::Messages::text(), HasSubstr("count is 0"));
    test::Messages::all().clear();
    ASSERT_EQ(dSoundListenersAddSink(ears.data(), 3, memory), 1);
    EXPECT_EQ(dSoundListenerAddSink(ears[0], memory), 0);
    EXPECT_THAT(test::Messages::text(), HasSubstr("serves another listener"));
    test::Messages::all().clear();
    EXPECT_EQ(dSoundListenersAddSink(ears.data(), 2, memory), 0);
    EXPECT_THAT(test::Messages::text(), HasSubstr("serves another listener"));
    test::Messages::all().clear();
    std::vector<dSoundListenerID> nine;
    for (int i = 0; i < 9; ++i) {
        nine.push_back(dSoundListenerCreate(world));
        dSoundListenerSetEars(nine.back(), 1);
    }
    sound::SinkHandle flac(dSoundSinkCreateFile(scratch.file("nine.flac").c_str()));
    EXPECT_EQ(dSoundListenersAddSink(nine.data(), 9, flac), 0);
    EXPECT_THAT(test::Messages::text(), HasSubstr("1 to 8 channels, not 9"));
    test::Messages::all().clear();
    EXPECT_EQ(dSoundListenersAddSink(nine.data(), 8, flac), 1) << test::Messages::text();
    run(2);
    flac.reset();
    EXPECT_EQ(sound::test::ReadSound(scratch.file("nine.flac")).info.channels, 8);
    dSoundFile quad = dSoundFileDefault();
    quad.speakers = 0x33;
    sound::SinkHandle wav(dSoundSinkCreateFileAs(scratch.file("quad.wav").c_str(), &quad));
    EXPECT_EQ(dSoundListenersAddSink(nine.data(), 3, wav), 0);
    EXPECT_THAT(test::Messages::text(), HasSubstr("4 loudspeakers for 3 channels"));
    EXPECT_EQ(dSoundListenersAddSink(nine.data(), 4, wav), 1);
}

} // namespace
