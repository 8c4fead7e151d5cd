#pragma once

#include "support/ode_app.h"

#include <ode_sound/sound.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace ode::test {

/// An ODE application with rigid bodies that sound, ears, and what these heard.
class RigidRing : public OdeApp {
public:
    static constexpr int kRate = 48000;

    explicit RigidRing(dReal gravity_z = 0)
        : OdeApp(gravity_z), soft(dSoftWorldCreate(world, space)), sound(dSoundWorldCreate(soft)),
          memory(dSoundSinkCreateMemory()), ears(dSoundListenerCreate(sound)) {
        dSoundSetFullScale(sound, 1); // samples are pascals
        dSoundListenerSetPosition(ears, 0, -1, 0);
        dSoundListenerSetEarDistance(ears, 0);
        dSoundListenerAddSink(ears, memory);
    }

    /// A steel bar along x that rings for about a second.
    struct Bar {
        dBodyID body;
        dSoundModalID voice;
    };
    static dSoftSolid metal() {
        dSoftSolid steel = dSoftSolidDefault();
        steel.alpha = 10;
        steel.beta = 1e-8;
        return steel;
    }
    static constexpr double kLength = 0.2, kWidth = 0.03, kThick = 0.02; ///< [m]

    Bar add_bar(dReal x, dReal y, dReal z) {
        const dSoftSolid steel = metal();
        const soft::MeshHandle mesh(dSoftMeshCreateBox(kLength, kWidth, kThick, 6, 1, 1));
        dMass mass;
        dMassSetBox(&mass, steel.density, kLength, kWidth, kThick);
        const dBodyID body = dBodyCreate(world);
        dBodySetMass(body, &mass);
        dBodySetPosition(body, x, y, z);
        dGeomSetBody(dCreateBox(space, kLength, kWidth, kThick), body);
        return {body, dSoundModalCreate(body, mesh, &steel)};
    }

    void run(double seconds, double h) {
        for (long i = std::lround(seconds / h); i > 0; --i)
            step(h);
    }

    /// Of one ear, till now [Pa]; all that was under way once the sound world has ended.
    std::vector<double> heard() const {
        const float* first = nullptr;
        int channels = 0;
        const unsigned long frames = dSoundSinkGetSamples(memory, &first, &channels);
        std::vector<double> out(frames);
        for (unsigned long i = 0; i < frames; ++i)
            out[i] = static_cast<double>(first[i * static_cast<unsigned long>(channels)]);
        return out;
    }

    static dSoundModalStatus status(dSoundModalID voice) {
        dSoundModalStatus s{};
        s.struct_size = sizeof s;
        dSoundModalGetStatus(voice, &s);
        return s;
    }

    soft::WorldHandle soft;
    sound::WorldHandle sound; ///< ends before the sink
    sound::SinkHandle memory;
    dSoundListenerID ears;
};

/// What is heard of two bars of which either is struck.
inline std::vector<double> two_bars(bool left, bool right) {
    RigidRing app;
    const RigidRing::Bar a = app.add_bar(0, 0.3, 0), b = app.add_bar(0, -0.3, 0.1);
    app.step(0.005);
    const dVector3 at[2] = {{0.08, 0.3, 0}, {-0.03, -0.3, 0.1}}, blow = {0, 0, 0.01};
    if (left)
        dSoundModalStrike(a.voice, at[0], blow, 1e-4);
    if (right)
        dSoundModalStrike(b.voice, at[1], blow, 2e-4);
    app.run(0.1, 0.005);
    return app.heard();
}

/// Amplitude of a frequency in the stretch from `from` to `to` [s], Hann window.
inline double line(const std::vector<double>& p, double f, double from, double to) {
    std::complex<double> sum = 0;
    const auto first = static_cast<std::size_t>(from * RigidRing::kRate);
    const auto count = static_cast<std::size_t>((to - from) * RigidRing::kRate);
    for (std::size_t i = 0; i < count && first + i < p.size(); ++i) {
        const double u = static_cast<double>(i) / static_cast<double>(count);
        sum +=
            p[first + i] * (1 - std::cos(2 * std::numbers::pi * u)) *
            std::polar(1.0, -2 * std::numbers::pi * f * static_cast<double>(i) / RigidRing::kRate);
    }
    return 2 * std::abs(sum) / static_cast<double>(count);
}

} // namespace ode::test
