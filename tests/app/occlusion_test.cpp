// What stands between a sounding body and an ear hides it: softly, by the application's own space.
#include "support/ringing_bar.h"

#include <ode_sound/sound.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace {

using namespace ode;

constexpr dReal kStep = 1.0 / 480; // [s]
constexpr int kRate = 48000;

/// A steel bar that rings from the first step on, an ear 1 m before it and a wall where asked for.
struct Ringing : test::RingingBar {
    Ringing() : RingingBar(0) {
        sound = sound::WorldHandle(dSoundWorldCreate(soft));
        ears = dSoundListenerCreate(sound);
        dSoundListenerSetPosition(ears, 0, -1, 0);
        memory = sound::SinkHandle(dSoundSinkCreateMemory());
        dSoundListenerAddSink(ears, memory);
    }
    dGeomID add_wall(dReal x) {
        const dGeomID wall = dCreateBox(space, 2, 0.1, 2);
        dGeomSetPosition(wall, x, -0.5, 0);
        return wall;
    }
    void run(int steps) {
        for (int i = 0; i < steps; ++i) {
            if (first)
                dSoftBodyAddForceAtNode(body, 0, 0, 0, 0.2); // it hardly moves
            first = false;
            step(kStep);
        }
    }
    dSoundStats stats() {
        dSoundStats s{};
        s.struct_size = sizeof s;
        dSoundGetStats(sound, &s);
        return s;
    }
    /// Left ear.
    std::vector<double> heard() const {
        const float* at = nullptr;
        int channels = 0;
        const unsigned long frames = dSoundSinkGetSamples(memory, &at, &channels);
        std::vector<double> out;
        for (unsigned long i = 0; i < frames; ++i)
            out.push_back(at[i * static_cast<unsigned long>(channels)]);
        return out;
    }
    double level(double begin, double end) const {
        const std::vector<double> all = heard();
        double sum = 0;
        int count = 0;
        for (auto i = static_cast<std::size_t>(begin * kRate);
             i < static_cast<std::size_t>(end * kRate) && i < all.size(); ++i, ++count)
            sum += all[i] * all[i];
        return std::sqrt(sum / std::max(count, 1));
    }

    sound::SinkHandle memory;
    sound::WorldHandle sound;
    dSoundListenerID ears = nullptr;
    bool first = true;
};

double open_level() {
    static const double level = [] {
        Ringing app;
        app.run(96);
        return app.level(0.1, 0.19);
    }();
    return level;
}

TEST(Occlusion, IsOffUnlessAskedFor) {
    Ringing app;
    app.add_wall(0);
    app.run(96);
    EXPECT_DOUBLE_EQ(app.level(0.1, 0.19), open_level());
    EXPECT_EQ(app.stats().rays, 0u);
}

TEST(Occlusion, WithNothingBetweenNoRayIsCast) {
    Ringing app;
    dCreatePlane(app.space, 0, 0, 1, -1);                     // a floor far below
    dGeomSetPosition(dCreateSphere(app.space, 0.2), 0, 3, 0); // behind the body
    dGeomSetPosition(dCreateBox(app.space, 1, 1, 1), 5, -0.5, 0);
    ASSERT_TRUE(dSoundSetOcclusion(app.sound, app.space, ~0ul));
    app.run(96);
    EXPECT_EQ(app.stats().rays, 0u);
    EXPECT_DOUBLE_EQ(app.level(0.1, 0.19), open_level());
}

TEST(Occlusion, AWallSilencesWhatItHides) {
    Ringing app;
    app.add_wall(0);
    ASSERT_TRUE(dSoundSetOcclusion(app.sound, app.space, ~0ul));
    app.run(96);
    EXPECT_GT(app.stats().rays, 100u);
    EXPECT_EQ(app.level(0.1, 0.19), 0.0);
}

// The wall ends at x = -0.05, half way from the bar's middle to the left ear at -0.1: one half of
// the bar is hidden.
TEST(Occlusion, HalfAWallHidesHalf) {
    Ringing app;
    app.add_wall(-1.05);
    ASSERT_TRUE(dSoundSetOcclusion(app.sound, app.space, ~0ul));
    app.run(96);
    EXPECT_NEAR(app.level(0.1, 0.19) / open_level(), 0.5, 0.01);
}

// Nobody looks at the nodes of a body that moves in its modes; it is hidden all the same.
TEST(Occlusion, BodiesInTheirModesAreHiddenToo) {
    const auto level = [](bool wall) {
        Ringing app;
        EXPECT_TRUE(dSoftBodySetTier(app.body, "modal"));
        if (wall)
            app.add_wall(0);
        EXPECT_TRUE(dSoundSetOcclusion(app.sound, app.space, ~0ul));
        app.run(96);
        EXPECT_EQ(app.stats().rays > 0, wall);
        return app.level(0.1, 0.19);
    };
    EXPECT_GT(level(false), 0.0);
    EXPECT_EQ(level(true), 0.0);
}

TEST(Occlusion, CategoriesChooseWhatHides) {
    Ringing app;
    dGeomSetCategoryBits(app.add_wall(0), 4);
    ASSERT_TRUE(dSoundSetOcclusion(app.sound, app.space, ~4ul));
    app.run(96);
    EXPECT_DOUBLE_EQ(app.level(0.1, 0.19), open_level());
}

TEST(Occlusion, SoftBodiesHideOthers) {
    Ringing app;
    soft::MeshHandle mesh(dSoftMeshCreateBox(1, 0.1, 1, 2, 1, 2));
    const dSoftSolid steel = dSoftSolidDefault();
    const dSoftBodyID plate = dSoftBodyCreate(app.soft, mesh, &steel);
    dSoftBodySetPosition(plate, 0, -0.5, 0);
    ASSERT_TRUE(dSoundSetBodyGain(app.sound, plate, 0));
    ASSERT_TRUE(dSoundSetOcclusion(app.sound, app.space, ~0ul));
    app.run(96);
    EXPECT_EQ(app.level(0.1, 0.19), 0.0);
}

// A wall that comes and goes makes no click: the largest step of the recording stays that of the
// tone.
TEST(Occlusion, ComesAndGoesSoftly) {
    const auto steepest = [](const std::vector<double>& all) {
        double most = 0;
        for (std::size_t i = kRate / 20; i < all.size(); ++i)
            most = std::max(most, std::abs(all[i] - all[i - 1]));
        return most;
    };
    Ringing open;
    open.run(192);
    Ringing app;
    const dGeomID wall = app.add_wall(50);
    ASSERT_TRUE(dSoundSetOcclusion(app.sound, app.space, ~0ul));
    for (const dReal x : {50, 0, 50, 0}) {
        dGeomSetPosition(wall, x, -0.5, 0);
        app.run(48);
    }
    EXPECT_LE(steepest(app.heard()), 1.02 * steepest(open.heard()));
    EXPECT_NEAR(app.level(0.25, 0.29) / open.level(0.25, 0.29), 1.0, 1e-6) << "it is clear again";
    EXPECT_LT(app.level(0.36, 0.39), 1e-9);
}

} // namespace
