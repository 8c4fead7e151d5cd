// What is heard of a load at rest: nothing above -140 dB of full scale at a metre, calibration as
// it comes (full scale 20 Pa, ode_sound/sound.h), once its own damping has brought it there; and
// nothing at all of what sleeps.
#include "support/ode_app.h"

#include <ode_sound/sound.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <vector>

namespace {

using namespace ode;

constexpr int kRate = 48000;
constexpr double kMark = -140; ///< [dB of full scale]

double decibels(double sample) { return 20 * std::log10(std::fmax(sample, 1e-20)); }

struct Heard {
    double impact; ///< peak of the first 0.2 s [dB of full scale]
    double rest;   ///< peak of the last half second
    double rms;    ///< there
};

/// @param build  makes the bodies; nothing rings on long after `settle` [s].
Heard listen(const std::function<void(test::OdeApp&, dSoftWorldID)>& build, double h,
             double settle) {
    test::OdeApp app(-9.81);
    const soft::WorldHandle soft(dSoftWorldCreate(app.world, app.space));
    build(app, soft);
    const sound::SinkHandle memory(dSoundSinkCreateMemory());
    sound::WorldHandle world(dSoundWorldCreate(soft));
    const dSoundListenerID ears = dSoundListenerCreate(world);
    dSoundListenerSetPosition(ears, 0.6, -0.8, 0.1);
    dSoundListenerAddSink(ears, memory);
    for (long i = std::lround((settle + 0.5) / h); i > 0; --i)
        app.step(h);
    const float* first = nullptr;
    int channels = 0;
    const auto frames = static_cast<long>(dSoundSinkGetSamples(memory, &first, &channels));
    const auto peak = [&](long from, long to) {
        double most = 0;
        for (long i = channels * from; i < channels * to; ++i)
            most = std::fmax(most, std::fabs(static_cast<double>(first[i])));
        return most;
    };
    double sum = 0;
    for (long i = channels * (frames - kRate / 2); i < channels * frames; ++i)
        sum += static_cast<double>(first[i]) * first[i];
    return {decibels(peak(0, kRate / 5)), decibels(peak(frames - kRate / 2, frames)),
            decibels(std::sqrt(sum / (channels * (kRate / 2))))};
}

dSoftSolid rubber(dReal young) {
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = young;
    solid.poisson = 0.3;
    solid.density = 1000;
    solid.alpha = 10;
    solid.beta = 1e-4;
    return solid;
}

void expect_silent(const char* what, const Heard& heard) {
    std::printf("%s: impact %.0f, at rest %.0f peak, %.0f rms [dB of full scale]\n", what,
                heard.impact, heard.rest, heard.rms);
    EXPECT_GT(heard.impact, -60) << "the listener hears";
    EXPECT_LT(heard.rest, kMark);
}

class Resting : public testing::TestWithParam<double> {};

TEST_P(Resting, SoftCubeOnAPlane) {
    const auto build = [](test::OdeApp& app, dSoftWorldID soft) {
        dCreatePlane(app.space, 0, 0, 1, 0);
        const soft::MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
        const dSoftSolid solid = rubber(1e6);
        dSoftBodySetPosition(dSoftBodyCreate(soft, mesh, &solid), 0, 0, 0.052);
    };
    // It rocks on the floor at 23 Hz, which the rubber's viscosity damps by 24 dB/s at first and
    // 6 dB/s in the end: -107 dB after 2 s, -132 after 3, -150 after 4.
    expect_silent("soft cube on a plane", listen(build, GetParam(), 4));
}

TEST_P(Resting, SoftCubeAsleep) {
    const auto build = [](test::OdeApp& app, dSoftWorldID soft) {
        dWorldSetAutoDisableFlag(app.world, 1);
        dCreatePlane(app.space, 0, 0, 1, 0);
        const soft::MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
        const dSoftSolid solid = rubber(1e6);
        dSoftBodySetPosition(dSoftBodyCreate(soft, mesh, &solid), 0, 0, 0.052);
    };
    const Heard heard = listen(build, GetParam(), 4);
    EXPECT_GT(heard.impact, -60) << "the listener hears";
    EXPECT_EQ(heard.rest, decibels(0)) << "zeros";
}

TEST_P(Resting, BoxOnASoftPlate) {
    const auto build = [](test::OdeApp& app, dSoftWorldID soft) {
        const soft::MeshHandle mesh(dSoftMeshCreatePlate(0.2, 0.2, 0.02, 10, 10, 1));
        const dSoftSolid solid = rubber(2e7);
        const dSoftBodyID plate = dSoftBodyCreate(soft, mesh, &solid);
        const dReal* x = nullptr;
        int stride = 0;
        std::vector<int> rim;
        const int nodes = dSoftBodyGetPositions(plate, &x, &stride);
        for (int i = 0; i < nodes; ++i)
            if (std::fmax(std::fabs(x[i * stride]), std::fabs(x[i * stride + 1])) > 0.0999)
                rim.push_back(i);
        dSoftBodyPinNodes(plate, rim.data(), static_cast<int>(rim.size()));
        const dBodyID box = dBodyCreate(app.world);
        dMass mass;
        dMassSetBoxTotal(&mass, 1, 0.06, 0.06, 0.04);
        dBodySetMass(box, &mass);
        dGeomSetBody(dCreateBox(app.space, 0.06, 0.06, 0.04), box);
        dBodySetPosition(box, 0.003, 0.002, 0.031);
    };
    expect_silent("box on a soft plate", listen(build, GetParam(), 0.7));
}

INSTANTIATE_TEST_SUITE_P(Step, Resting, testing::Values(1e-3, 1.0 / 240, 16e-3));

} // namespace
