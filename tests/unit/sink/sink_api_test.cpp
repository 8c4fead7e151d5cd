#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ode/ode.h>
#include <ode_sound/sound.h>
#include <string>

namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string told;

void listen(int, const char* text, std::va_list arguments) {
    char sentence[1024];
    std::vsnprintf(sentence, sizeof sentence, text, arguments);
    told += sentence;
}

struct SinkApi : testing::Test {
    SinkApi() {
        told.clear();
        dSetMessageHandler(listen);
    }
    ~SinkApi() override { dSetMessageHandler(nullptr); }
};

TEST_F(SinkApi, EachKindTellsItsName) {
    const std::string path = testing::TempDir() + "sink_api.wav";
    dSoundSinkID null = dSoundSinkCreateNull();
    dSoundSinkID memory = dSoundSinkCreateMemory();
    dSoundSinkID file = dSoundSinkCreateFile(path.c_str());
    ASSERT_TRUE(null && memory && file);
    EXPECT_STREQ(dSoundSinkGetKind(null), "null");
    EXPECT_STREQ(dSoundSinkGetKind(memory), "memory");
    EXPECT_STREQ(dSoundSinkGetKind(file), "file");
    for (dSoundSinkID sink : {null, memory, file}) {
        EXPECT_STREQ(dSoundSinkGetError(sink), "");
        EXPECT_EQ(dSoundSinkGetBacklog(sink), 0U);
        dSoundSinkDestroy(sink);
    }
    dSoundSinkDestroy(nullptr);
    EXPECT_EQ(told, "");
    EXPECT_FALSE(std::filesystem::exists(path)) << "an unused file sink leaves nothing";
}

TEST_F(SinkApi, BadPathIsNullAndASentence) {
    EXPECT_EQ(dSoundSinkCreateFile("/nowhere/at/all.wav"), nullptr);
    EXPECT_THAT(told, AllOf(HasSubstr("dSoundSinkCreateFile"), HasSubstr("/nowhere/at/all.wav"),
                            HasSubstr("No such file")));
}

TEST_F(SinkApi, OnlyMemorySinksGiveSamplesBack) {
    dSoundSinkID null = dSoundSinkCreateNull();
    const float* first = reinterpret_cast<const float*>(&null);
    int channels = 7;
    EXPECT_EQ(dSoundSinkGetSamples(null, &first, &channels), 0U);
    EXPECT_EQ(first, nullptr);
    EXPECT_EQ(channels, 0);
    EXPECT_THAT(told, AllOf(HasSubstr("null sink"), HasSubstr("dSoundSinkCreateMemory")));
    dSoundSinkDestroy(null);
    dSoundSinkID memory = dSoundSinkCreateMemory();
    EXPECT_EQ(dSoundSinkGetSamples(memory, &first, &channels), 0U);
    EXPECT_EQ(channels, 1);
    dSoundSinkDestroy(memory);
}

// In processes of their own, since OpenAL reads ALSOFT_DRIVERS once.
[[noreturn]] void create_openal(const char* drivers, const char* expected_kind) {
    setenv("ALSOFT_DRIVERS", drivers, 1);
    told.clear();
    dSetMessageHandler(listen);
    dSoundSinkID sink = dSoundSinkCreateOpenAL();
    const std::string kind = sink ? dSoundSinkGetKind(sink) : "nothing";
    dSoundSinkDestroy(sink);
    std::fprintf(stderr, "%s", told.c_str());
    std::exit(kind == expected_kind ? 0 : 1);
}

TEST_F(SinkApi, OpenAlOnNullDriverIsLive) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(create_openal("null", "openal"), testing::ExitedWithCode(0), "");
}

TEST_F(SinkApi, WithoutDeviceANullSinkTakesOverWithAMessage) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(create_openal("nonexistent", "null"), testing::ExitedWithCode(0),
                "dSoundSinkCreateOpenAL: OpenAL finds no sound device.*null sink");
}

[[noreturn]] void ask_rate(const char* drivers, bool expected) {
    setenv("ALSOFT_DRIVERS", drivers, 1);
    told.clear();
    dSetMessageHandler(listen);
    const int rate = dSoundGetDeviceRate();
    std::fprintf(stderr, "%s", told.c_str());
    std::exit(expected == (rate >= 8000) ? 0 : 1);
}

TEST_F(SinkApi, DeviceTellsItsRate) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(ask_rate("null", true), testing::ExitedWithCode(0), "");
    EXPECT_EXIT(ask_rate("nonexistent", false), testing::ExitedWithCode(0), "no sound device");
}

TEST_F(SinkApi, PaceReturnsAtOnceWithoutAClock) {
    dSoundSinkID sink = dSoundSinkCreateNull();
    EXPECT_LT(dSoundSinkPace(sink, 0.0), 0.1);
    EXPECT_EQ(dSoundSinkPace(sink, -1.0), 0.0); // refused in words
    dSoundSinkDestroy(sink);
}

} // namespace
