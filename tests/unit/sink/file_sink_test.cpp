#include "read_sound.h"
#include "scratch.h"
#include "signals.h"
#include "sink/file_sink.h"
#include "sink/wav_header.h"

#include <csignal>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

namespace ode::sound {
namespace {

using testing::AllOf;
using testing::HasSubstr;
constexpr Format kStereo{48000, 2};

std::string refusal(const std::string& path) {
    try {
        FileSink sink(path);
        return "accepted";
    } catch (const Refused& e) {
        return e.what();
    }
}

/// In blocks of 700 frames, which divide neither a second nor a FLAC frame.
void write_all(Sink& sink, std::span<const float> x) {
    for (std::size_t at = 0; at < x.size(); at += 2 * 700)
        sink.write(x.subspan(at, std::min<std::size_t>(x.size() - at, 2 * 700)));
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

TEST(FileSink, WavIsFloatOfGivenRateAndRepeatsByteForByte) {
    const test::Scratch scratch;
    auto x = test::noise(2 * 60'001);
    x[5] = 3.5F; // louder than full scale is kept
    for (const char* name : {"a.wav", "b.WAV"}) {
        FileSink sink(scratch.file(name));
        ASSERT_TRUE(sink.open({44100, 2}));
        write_all(sink, x);
        sink.close();
        EXPECT_STREQ(sink.error(), "");
    }
    const test::ReadSound read(scratch.file("a.wav"));
    EXPECT_EQ(read.info.samplerate, 44100);
    EXPECT_EQ(read.info.channels, 2);
    EXPECT_EQ(read.info.frames, 60'001);
    EXPECT_EQ(read.info.format, SF_FORMAT_WAV | SF_FORMAT_FLOAT);
    EXPECT_EQ(read.sample, x);
    const std::string bytes = test::bytes_of(scratch.file("a.wav"));
    EXPECT_EQ(bytes, test::bytes_of(scratch.file("b.WAV")));
    EXPECT_EQ(bytes.substr(0, 100).find("PEAK"), std::string::npos);
    EXPECT_EQ(number_at(bytes, 4), bytes.size() - 8); // RIFF's size
}

TEST(FileSink, FlacHoldsTwentyFourBits) {
    const test::Scratch scratch;
    const auto x = test::noise(2 * 50'000);
    for (const char* name : {"a.flac", "b.flac"}) {
        FileSink sink(scratch.file(name));
        ASSERT_TRUE(sink.open(kStereo));
        write_all(sink, x);
        sink.close();
        EXPECT_STREQ(sink.error(), "");
    }
    const test::ReadSound read(scratch.file("a.flac"));
    ASSERT_EQ(read.sample.size(), x.size());
    for (std::size_t i = 0; i < x.size();
         ++i) // half a step, and a full one at +1, which has no code
        ASSERT_NEAR(read.sample[i], x[i], x[i] > 1 - 1.2e-7 ? 1.2e-7 : 0.51 / (1 << 23)) << i;
    EXPECT_EQ(test::bytes_of(scratch.file("a.flac")), test::bytes_of(scratch.file("b.flac")));
}

TEST(FileSink, FlacTellsOfClipping) {
    const test::Scratch scratch;
    FileSink sink(scratch.file("loud.flac"));
    ASSERT_TRUE(sink.open(kStereo));
    std::vector<float> x(2 * 4800, 0.5F);
    x[2 * 2400 + 1] = -1.5F;
    sink.write(x);
    sink.close();
    EXPECT_THAT(sink.error(),
                AllOf(HasSubstr("loud.flac"), HasSubstr("0.050 s"), HasSubstr(".wav")));
    const test::ReadSound read(scratch.file("loud.flac"));
    EXPECT_EQ(read.sample[2 * 2400 + 1], -1.0F);
}

TEST(FileSink, RefusesPathsItCannotWriteWithACure) {
    const test::Scratch scratch;
    EXPECT_THAT(
        refusal(scratch.file("no/such/folder.wav")),
        AllOf(HasSubstr("folder.wav"), HasSubstr("No such file"), HasSubstr("make the folder")));
    std::filesystem::create_directory(scratch.file("folder.wav"));
    EXPECT_THAT(refusal(scratch.file("folder.wav")),
                AllOf(HasSubstr("Is a directory"), HasSubstr("add a file name")));
    EXPECT_THAT(refusal("/proc/sound.wav"), HasSubstr("cannot be written")) << "not even for root";
    for (const char* path : {"sound.mp3", "sound", "", "wav"})
        EXPECT_THAT(refusal(path),
                    AllOf(HasSubstr("ending"), HasSubstr(".wav"), HasSubstr(".flac")));
    ASSERT_EQ(mkfifo(scratch.file("pipe.wav").c_str(), 0600), 0);
    EXPECT_THAT(refusal(scratch.file("pipe.wav")), HasSubstr("is a pipe"));
}

TEST(FileSink, UnusedSinkLeavesNothingAndKeepsOldContent) {
    const test::Scratch scratch;
    std::ofstream(scratch.file("old.wav")) << "precious";
    {
        FileSink fresh(scratch.file("new.wav"));
        FileSink old(scratch.file("old.wav"));
    }
    EXPECT_FALSE(std::filesystem::exists(scratch.file("new.wav")));
    EXPECT_EQ(test::bytes_of(scratch.file("old.wav")), "precious");
}

TEST(FileSink, LongerOldFileIsReplacedWhole) {
    const test::Scratch scratch;
    std::ofstream(scratch.file("a.wav")) << std::string(100'000, 'x');
    FileSink sink(scratch.file("a.wav"));
    ASSERT_TRUE(sink.open(kStereo));
    sink.write(std::vector<float>(20, 0.5F));
    sink.close();
    EXPECT_EQ(test::ReadSound(scratch.file("a.wav")).sample, std::vector<float>(20, 0.5F));
    EXPECT_LT(test::bytes_of(scratch.file("a.wav")).size(), 300U);
}

TEST(FileSink, ReopeningContinuesOnlyTheSameStream) {
    const test::Scratch scratch;
    FileSink sink(scratch.file("a.wav"));
    ASSERT_TRUE(sink.open(kStereo));
    sink.write(std::vector<float>(20, 0.5F));
    EXPECT_TRUE(sink.open(kStereo));
    sink.write(std::vector<float>(20, 0.25F));
    EXPECT_FALSE(sink.open({44100, 2}));
    EXPECT_THAT(sink.error(), AllOf(HasSubstr("48000"), HasSubstr("44100")));
    sink.close();
    EXPECT_EQ(sink.write(std::vector<float>(20)), 10U) << "closed: taken and forgotten";
    EXPECT_EQ(test::ReadSound(scratch.file("a.wav")).sample.size(), 40U);
}

/// Runs `body` in a child that ends without any clean-up. @return its exit status
template <class Body>
int in_child(Body body) {
    const pid_t child = fork();
    if (child == 0)
        _exit(body());
    int status = -1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(FileSink, CrashLosesAQuarterSecondAtMost) {
    const test::Scratch scratch;
    const auto x = test::noise(2 * 100'000);
    for (const char* name : {"crash.wav", "crash.flac"}) {
        ASSERT_EQ(in_child([&] {
                      auto* sink = new FileSink(scratch.file(name)); // never destroyed
                      if (!sink->open(kStereo))
                          return 1;
                      write_all(*sink, x);
                      return 0;
                  }),
                  0);
        const test::ReadSound read(scratch.file(name));
        const std::size_t frames = read.sample.size() / 2;
        EXPECT_GE(frames, 100'000 - 12'000 - 700U) << name;
        EXPECT_LT(frames, 100'000U) << name << ": was it closed after all?";
        for (std::size_t i = 0; i < 2 * frames; ++i)
            ASSERT_NEAR(read.sample[i], x[i], 1.2e-7) << name << " " << i;
    }
}

TEST(FileSink, DeviceThatIsFullIsToldOfAtOpening) {
    const test::Scratch scratch;
    for (const char* name : {"full.wav", "full.flac"}) {
        std::filesystem::create_symlink("/dev/full", scratch.file(name));
        FileSink sink(scratch.file(name));
        sink.open(kStereo); // FLAC's encoder may first fail while writing
        const auto x = test::noise(2 * 100'000);
        EXPECT_EQ(sink.write(x), 100'000U) << "taken and forgotten";
        sink.close();
        EXPECT_THAT(sink.error(),
                    AllOf(HasSubstr(name), HasSubstr("No space left"), HasSubstr("free space")));
    }
}

// A limit on file size stands for a disk that fills while writing: both fail the write.
TEST(FileSink, FullDiskKeepsWhatWasWritten) {
    const test::Scratch scratch;
    const auto x = test::noise(2 * 100'000);
    for (const char* name : {"part.wav", "part.flac"}) {
        const int status = in_child([&] {
            signal(SIGXFSZ, SIG_IGN);
            const rlimit limit{400'003, 400'003}; // inside of a frame
            setrlimit(RLIMIT_FSIZE, &limit);
            FileSink sink(scratch.file(name));
            if (!sink.open(kStereo))
                return 1;
            write_all(sink, x);
            sink.close();
            return std::string(sink.error()).find("stay in the file") == std::string::npos ? 2 : 0;
        });
        ASSERT_EQ(status, 0) << name;
        const test::ReadSound read(scratch.file(name));
        // 8 bytes a frame of WAV, at least 5 of noise in FLAC; less one block of either's.
        EXPECT_GE(read.sample.size() / 2, 400'003U / 8 - 4096) << name;
        for (std::size_t i = 0; i < read.sample.size(); ++i)
            ASSERT_NEAR(read.sample[i], x[i], 1.2e-7) << name << " " << i;
    }
}

// A sparse file: 4.8 GB by its length, one page by its blocks.
TEST(FileSink, HeaderGrowsIntoRf64BeyondFourGigabytes) {
    const test::Scratch scratch;
    const std::string path = scratch.file("long.wav");
    for (const int channels : {2, 6}) {
        const auto frame = 4U * static_cast<std::uint64_t>(channels);
        const std::uint64_t before =
            (0xFFFFFFFEU - ((channels == 2 ? kWavHeaderSize : kWideWavHeaderSize) - 8)) / frame;
        for (const std::uint64_t frames : {before, before + 1, std::uint64_t{600'000'000}}) {
            const auto header = wav_header({48000, channels}, frames);
            std::ofstream(path, std::ios::binary)
                .write(reinterpret_cast<const char*>(header.data()),
                       static_cast<std::streamsize>(header.size()));
            std::filesystem::resize_file(path, header.size() + frame * frames);
            SF_INFO info{};
            SNDFILE* file = sf_open(path.c_str(), SFM_READ, &info);
            ASSERT_NE(file, nullptr) << sf_strerror(nullptr);
            sf_close(file);
            EXPECT_EQ(static_cast<std::uint64_t>(info.frames), frames);
            EXPECT_EQ(info.channels, channels);
            EXPECT_EQ(info.format & SF_FORMAT_TYPEMASK, frames > before ? SF_FORMAT_RF64
                                                        : channels > 2  ? SF_FORMAT_WAVEX
                                                                        : SF_FORMAT_WAV);
        }
    }
}

} // namespace
} // namespace ode::sound
