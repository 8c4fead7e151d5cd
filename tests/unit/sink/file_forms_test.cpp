// Files of 24 and 16 bits, and the note beside a file.
#include "dsp/spectra.h"
#include "read_sound.h"
#include "scratch.h"
#include "signals.h"
#include "sink/file_sink.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numbers>

namespace ode::sound {
namespace {

struct Form {
    const char* name;
    int bits;
    int format;
    int channels = 2;
};

class FileForm : public testing::TestWithParam<Form> {};

TEST_P(FileForm, HoldsSamplesToItsStep) {
    const test::Scratch scratch;
    const std::string path = scratch.file(GetParam().name);
    const std::vector<float> x =
        test::noise(static_cast<std::size_t>(GetParam().channels) * 10'001);
    FileSink sink(path, GetParam().bits);
    ASSERT_TRUE(sink.open({48000, GetParam().channels})) << sink.error();
    sink.write(x);
    sink.close();
    EXPECT_STREQ(sink.error(), "");
    const test::ReadSound read(path);
    EXPECT_EQ(read.info.format, GetParam().format);
    EXPECT_EQ(read.info.channels, GetParam().channels);
    ASSERT_EQ(read.sample.size(), x.size());
    // Rounding takes half a step, dither up to one more.
    const float step = GetParam().bits == 16 ? 0x1p-15F : 0x1p-23F;
    for (std::size_t i = 0; i < x.size(); ++i)
        ASSERT_NEAR(read.sample[i], x[i], 1.6F * step + 1e-7F);
}
INSTANTIATE_TEST_SUITE_P(Forms, FileForm,
                         testing::Values(Form{"a.wav", 24, SF_FORMAT_WAV | SF_FORMAT_PCM_24},
                                         Form{"a.wav", 16, SF_FORMAT_WAV | SF_FORMAT_PCM_16},
                                         Form{"a.flac", 24, SF_FORMAT_FLAC | SF_FORMAT_PCM_24},
                                         Form{"a.flac", 16, SF_FORMAT_FLAC | SF_FORMAT_PCM_16}));

// WAVE_FORMAT_EXTENSIBLE, read by libsndfile.
INSTANTIATE_TEST_SUITE_P(Multichannel, FileForm,
                         testing::Values(Form{"a.wav", 32, SF_FORMAT_WAVEX | SF_FORMAT_FLOAT, 3},
                                         Form{"a.wav", 32, SF_FORMAT_WAVEX | SF_FORMAT_FLOAT, 64},
                                         Form{"a.wav", 24, SF_FORMAT_WAVEX | SF_FORMAT_PCM_24, 4},
                                         Form{"a.wav", 16, SF_FORMAT_WAVEX | SF_FORMAT_PCM_16, 6},
                                         Form{"a.flac", 24, SF_FORMAT_FLAC | SF_FORMAT_PCM_24, 8},
                                         Form{"a.flac", 16, SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 3}));

std::vector<int> loudspeakers(const std::string& path) {
    SF_INFO info{};
    SNDFILE* file = sf_open(path.c_str(), SFM_READ, &info);
    std::vector<int> map(static_cast<std::size_t>(info.channels));
    if (!sf_command(file, SFC_GET_CHANNEL_MAP_INFO, map.data(),
                    static_cast<int>(map.size() * sizeof(int))))
        map.clear();
    sf_close(file);
    return map;
}

TEST(FileForms, ChannelsAreForLoudspeakersOnlyWhereAsked) {
    const test::Scratch scratch;
    for (const std::uint32_t speakers : {0U, 0x33U, 0x107U}) {
        const std::string path = scratch.file("quad.wav");
        FileSink sink(path, 0, false, speakers);
        ASSERT_TRUE(sink.open({48000, 4})) << sink.error();
        sink.write(test::noise(4 * 100));
        sink.close();
        if (speakers == 0)
            EXPECT_EQ(loudspeakers(path), std::vector<int>{});
        else if (speakers == 0x33)
            EXPECT_EQ(loudspeakers(path),
                      (std::vector<int>{SF_CHANNEL_MAP_LEFT, SF_CHANNEL_MAP_RIGHT,
                                        SF_CHANNEL_MAP_REAR_LEFT, SF_CHANNEL_MAP_REAR_RIGHT}));
        else
            EXPECT_EQ(loudspeakers(path).back(), SF_CHANNEL_MAP_REAR_CENTER);
    }
}

TEST(FileForms, ChannelsThatCannotBeAreRefusedInWords) {
    const test::Scratch scratch;
    const auto told = [&](const char* name, int channels, std::uint32_t speakers = 0) {
        FileSink sink(scratch.file(name), 0, false, speakers);
        EXPECT_FALSE(sink.open({48000, channels}));
        EXPECT_EQ(sink.write(std::vector<float>(10)), 10u) << "forgotten";
        return std::string(sink.error());
    };
    EXPECT_NE(told("a.flac", 9).find("1 to 8 channels, not 9"), std::string::npos);
    EXPECT_NE(told("a.wav", 0).find("not 0"), std::string::npos);
    EXPECT_NE(told("a.wav", -2).find("not -2"), std::string::npos);
    EXPECT_NE(told("a.wav", 5000).find("1 to 4096 channels"), std::string::npos);
    EXPECT_NE(told("a.wav", 4, 0x7).find("3 loudspeakers for 4 channels"), std::string::npos);
    EXPECT_THROW(FileSink(scratch.file("b.flac"), 0, false, 0x33), Refused);
}

// A third of a step would be lost by rounding; with dither it stands out of the noise, undistorted.
TEST(FileForms, DitherKeepsWhatIsQuieterThanAStep) {
    const test::Scratch scratch;
    const std::string path = scratch.file("quiet.wav");
    const double frequency = 1000.0;
    std::vector<float> x(48000 * 2);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = static_cast<float>(
            0x1p-15 / 3.0 *
            std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / 48000.0));
    FileSink sink(path, 16);
    ASSERT_TRUE(sink.open({48000, 1}));
    sink.write(x);
    sink.close();
    const test::ReadSound read(path);
    const std::vector<double> out(read.sample.begin(), read.sample.end());
    const double tone = std::abs(phasor(out, 48000.0, frequency));
    EXPECT_NEAR(tone / (0x1p-15 / 3.0), 1.0, 0.05);
    EXPECT_LT(std::abs(phasor(out, 48000.0, 3.0 * frequency)), 0.05 * tone);
}

TEST(FileForms, SilenceStaysZero) {
    const test::Scratch scratch;
    FileSink sink(scratch.file("silence.wav"), 16);
    ASSERT_TRUE(sink.open({48000, 2}));
    sink.write(std::vector<float>(2000, 0.0F));
    sink.close();
    for (const float s : test::ReadSound(scratch.file("silence.wav")).sample)
        ASSERT_EQ(s, 0.0F);
}

TEST(FileForms, WhatCannotBeIsRefusedInWords) {
    const test::Scratch scratch;
    for (const auto& [name, bits] : {std::pair{"a.flac", 32}, {"a.wav", 20}, {"a.wav", -1}})
        try {
            FileSink sink(scratch.file(name), bits);
            ADD_FAILURE() << name << " of " << bits << " bits";
        } catch (const Refused& e) {
            EXPECT_NE(std::string(e.what()).find("24 or 16"), std::string::npos) << e.what();
        }
}

TEST(FileForms, NoteTellsUnitCalibrationAndEvents) {
    const test::Scratch scratch;
    FileSink sink(scratch.file("a.wav"), 24, true);
    ASSERT_TRUE(sink.open({44100, 2}));
    sink.calibrate({2.5, "Pa", "monopole", "sinc", 0.25});
    EXPECT_TRUE(nlohmann::json::parse(std::ifstream(scratch.file("a.json"))).contains("full_scale"))
        << "it is there before the program can die";
    sink.write(test::noise(2 * 441));
    EXPECT_TRUE(sink.mark("a \"hit\"\non the rim"));
    sink.write(test::noise(2 * 441));
    sink.close();
    const auto note = nlohmann::json::parse(std::ifstream(scratch.file("a.json")));
    EXPECT_EQ(note["sound"], "a.wav");
    EXPECT_EQ(note["encoding"], "integer 24");
    EXPECT_EQ(note["frames"], 882);
    EXPECT_EQ(note["full_scale"], 2.5);
    EXPECT_EQ(note["unit"], "Pa");
    EXPECT_EQ(note["start"], 0.25);
    ASSERT_EQ(note["events"].size(), 1u);
    EXPECT_EQ(note["events"][0]["frame"], 441);
    EXPECT_EQ(note["events"][0]["text"], "a \"hit\"\non the rim");
    FileSink plain(scratch.file("b.wav"));
    EXPECT_FALSE(plain.mark("nothing to note it in"));
}

} // namespace
} // namespace ode::sound
