#include "plots/sound_picture.h"

#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace {

/// Noise: the picture that compresses worst.
std::vector<float> noise() {
    std::mt19937 random(1);
    std::normal_distribution<float> sample(0, 1);
    std::vector<float> x(96000);
    for (float& v : x)
        v = sample(random);
    return x;
}

plots::SoundPicture picture_of(std::span<const float> signal) {
    static const std::vector<double> lines = {500, 1500};
    return {"it's a test", signal, 48000, lines, 20000};
}

TEST(Picture, IsDrawnAndSmallEvenOfNoise) {
    const std::string path = testing::TempDir() + "softsound's picture.png";
    std::filesystem::remove(path);
    const std::vector<float> x = noise();
    ASSERT_EQ(plots::draw(picture_of(x), path), "");
    EXPECT_GT(std::filesystem::file_size(path), 5000U);
    EXPECT_LT(std::filesystem::file_size(path), 100000U);
    std::filesystem::remove(path);
}

TEST(Picture, WithoutGnuplotASentenceSaysSo) {
    const std::vector<float> x(48000, 0.1F);
    const std::string path = getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    const std::string said = plots::draw(picture_of(x), "/nowhere/x.png");
    setenv("PATH", path.c_str(), 1);
    EXPECT_THAT(said, testing::HasSubstr("gnuplot is not installed"));
}

TEST(Picture, OfNothingOrNowhereIsRefused) {
    const std::vector<float> x(48000, 0.1F);
    EXPECT_NE(plots::draw(picture_of({}), "x.png"), "");
    EXPECT_NE(plots::draw(picture_of(x), "/nowhere/at/all/x.png"), "");
}

} // namespace
