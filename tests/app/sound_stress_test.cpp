// Ears where no ears should be, and bodies that go unstable while somebody listens: what is heard
// stays finite, as long as time, and without clicks louder than the sound.
#include "support/ringing_bar.h"
#include "support/soft_app.h"

#include <ode_sound/sound.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace {

using namespace ode;

constexpr dReal kStep = 1.0 / 480; // [s]
constexpr int kRate = 48000;

using Point = std::array<dReal, 3>;
using Place = std::function<Point(int step)>;

/// Frames of the left ear.
std::vector<float> heard(const Place& place, int steps) {
    test::RingingBar app(1e-7); // struck once
    sound::WorldHandle world(dSoundWorldCreate(app.soft));
    dSoundListenerID ears = dSoundListenerCreate(world);
    sound::SinkHandle memory(dSoundSinkCreateMemory());
    dSoundListenerAddSink(ears, memory);
    for (int i = 0; i < steps; ++i) {
        const Point at = place(i);
        EXPECT_TRUE(dSoundListenerSetPosition(ears, at[0], at[1], at[2]));
        if (i == 2)
            dSoftBodyAddForceAtNode(app.body, 0, 0, 0, 200);
        app.step(kStep);
    }
    const float* first = nullptr;
    int channels = 0;
    const unsigned long frames = dSoundSinkGetSamples(memory, &first, &channels);
    std::vector<float> left;
    for (unsigned long i = 0; i < frames; ++i)
        left.push_back(first[i * static_cast<unsigned long>(channels)]);
    return left;
}

float peak(const std::vector<float>& samples) {
    float most = 0;
    for (const float s : samples) {
        EXPECT_TRUE(std::isfinite(s));
        most = std::max(most, std::abs(s));
    }
    return most;
}

Point at_rest(int) { return {0, -1, 0}; }

TEST(SoundStress, EarsInsideTheBodyOrOnItHearFiniteSound) {
    for (const Point& at : {Point{0, 0, 0}, Point{0.01, 0, 0}, Point{-0.1, -0.015, -0.01},
                            Point{0, -0.015, 0}, Point{0.1, 0, 0.01}}) {
        const float most = peak(heard([&](int) { return at; }, 20));
        EXPECT_GT(most, 0);
    }
}

// Past the bar at the speed of sound and beyond: finite. How loud it may be is not judged here.
TEST(SoundStress, EarsFasterThanSoundHearFiniteSound) {
    for (const dReal speed : {340.0, 345.0, 480.0, 2000.0}) {
        const auto passing = [&](int i) { return Point{speed * kStep * (i - 30), -0.5, 0}; };
        EXPECT_GT(peak(heard(passing, 60)), 0) << speed;
    }
}

// A leap of 1 to 100 m while the bar rings: no sample is louder than where the louder of both
// places is, and the step from one sample to the next no larger than the sound's own.
TEST(SoundStress, ALeapMakesNoClick) {
    const std::vector<float> here = heard(at_rest, 60);
    const auto steepest = [](const std::vector<float>& s) {
        float most = 0;
        for (std::size_t i = 1; i < s.size(); ++i)
            most = std::max(most, std::abs(s[i] - s[i - 1]));
        return most;
    };
    for (const dReal way : {1.0, 10.0, 100.0}) {
        const std::vector<float> leapt = heard(
            [&](int i) {
                return i < 30 ? Point{0, -1, 0} : Point{0, -1 - way, 0};
            },
            60);
        EXPECT_LE(peak(leapt), 1.05 * peak(here)) << way;
        EXPECT_LE(steepest(leapt), 1.05 * steepest(here)) << way;
    }
}

// A soft cube thrown too hard under the law that collapses: what becomes of it is told, its energy
// never grows tenfold, and the sound goes on, sample by sample, and is finite.
TEST(SoundStress, ABodyThatCollapsesIsToldOfAndSoundGoesOn) {
    test::OdeApp app;
    const test::Messages messages;
    soft::WorldHandle soft(dSoftWorldCreate(app.world, app.space));
    dCreatePlane(app.space, 0, 0, 1, 0);
    const dSoftBodyID cube = test::add_cube(soft, 0.1, 0.055, 4);
    dSoftBodySetLinearVel(cube, 0, 0, -18);
    const dReal thrown = dSoftBodyGetEnergy(cube).kinetic;
    sound::WorldHandle world(dSoundWorldCreate(soft));
    dSoundListenerID ears = dSoundListenerCreate(world);
    dSoundListenerSetPosition(ears, 0, -1, 0);
    sound::SinkHandle memory(dSoundSinkCreateMemory());
    dSoundListenerAddSink(ears, memory);
    dReal most = 0;
    dSoftWorldAddSubstepObserver(
        soft,
        [](void* data, const dSoftSubstep* substep) {
            const dSoftEnergy energy = dSoftBodyGetEnergy(substep->body);
            auto& worst = *static_cast<dReal*>(data);
            worst = std::max(worst, energy.kinetic + energy.elastic);
        },
        &most);
    constexpr int kSteps = 48;
    for (int i = 0; i < kSteps; ++i)
        app.step(kStep);
    EXPECT_GT(test::Messages::with("is redone") + test::Messages::with("is stopped") +
                  test::Messages::with("inside out"),
              0);
    EXPECT_LT(most, 10 * thrown);
    const float* first = nullptr;
    int channels = 0;
    const unsigned long frames = dSoundSinkGetSamples(memory, &first, &channels);
    // What is on its way through the filters is not out yet.
    EXPECT_NEAR(double(frames), kSteps * kStep * kRate, 0.01 * kRate);
    peak({first, first + frames * static_cast<unsigned long>(channels)});
}

} // namespace
