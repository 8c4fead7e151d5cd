// Gains of a body that tumbles before an ear, looked up now and then, against gains of every
// sample.
#include "mix/voice_gains.h"
#include "source/node_rule.h"
#include "source/struck_voice.h"

#include "../transfer/shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace ode::sound {
namespace {

constexpr double kTau = 2 * std::numbers::pi;
constexpr double kRate = 48000.0;

/// A bar of 0.35 x 0.04 x 0.008 m: bending waves up to 20 kHz, as on a beam in the middle of it.
const TransferTable& bar() {
    static const TransferTable table = [] {
        ModalSurface surface;
        surface.mesh = test::block(Vec3(0.35, 0.04, 0.008), {32, 4, 1});
        for (int n = 1; n <= 12; ++n) {
            surface.frequency.push_back(338 * std::pow((n + 0.5) / 1.5, 2) * (n < 8 ? 1 : 0.9));
            for (const Vec3& x : surface.mesh.node)
                surface.shape.insert(
                    surface.shape.end(),
                    {0.0, 0.0, std::cos((n + 1) * std::numbers::pi * (x[0] / 0.35 + 0.5))});
        }
        return node_table(surface, Leaning::kCarried, Air{}, 2 * kRate);
    }();
    return table;
}

/// How far what is heard of a bar that turns so often a second [1/s], a metre away, is off, of
/// itself: so many modes from the lowest on, each as loud as the others. @param allowance  as
/// VoiceGains has it.
double error(double turns, std::size_t modes, double allowance) {
    const TransferTable& table = bar();
    StruckVoiceModel model;
    for (const TransferTable::Mode& mode : table.mode) {
        model.omega.push_back(kTau * mode.frequency);
        model.decay.push_back(1.0);
        model.level.push_back(1.0);
    }
    model.rigid.radius = 0.05;
    find_steps(model, kRate);
    const std::size_t columns = model.columns;
    std::vector<double> strength(modes, 0.0);
    std::vector<ModeGain> gain(table.mode.size());
    for (int i = 0; i < 64; ++i) { // about the same of each, over all directions
        const Vec3 way = Vec3(std::cos(2.4 * i), std::sin(2.4 * i), 2 * (i + 0.5) / 64 - 1);
        table.gains(way.normalized(), gain);
        for (std::size_t k = 0; k < modes; ++k)
            strength[k] += std::pow(static_cast<double>(gain[k].velocity), 2) +
                           std::pow(model.omega[k] * static_cast<double>(gain[k].acceleration), 2);
    }
    VoiceGains gains(table, ClickColumns::kCount);
    VoiceGains* const one[] = {&gains};
    const Vec3 ear(0, 0, 1), axis = Vec3(0.3, 1, 0.2).normalized();
    AlignedFloats q(columns * ModalRun::kMost), v(q);
    double off = 0, all = 0;
    const int samples = 60;
    for (int run = 0; run < 500; ++run) {
        ModalRun now{};
        now.sample = 2 * run * samples;
        now.every = 2;
        now.samples = samples;
        now.columns = static_cast<int>(columns);
        now.amplitude = q.data();
        now.rate = v.data();
        const auto turned = [&](double sample) {
            return Eigen::AngleAxisd(kTau * turns * sample / kRate, axis).toRotationMatrix();
        };
        now.rotation = turned(run * samples);
        now.table = &table;
        now.click = &model.click;
        for (int s = 0; s < samples; ++s)
            for (std::size_t k = 0; k < modes; ++k) {
                const double w = model.omega[k], size = 1 / std::sqrt(strength[k] / 64);
                const double phase = w * (run * samples + s) / kRate + static_cast<double>(k * k);
                const std::size_t at = static_cast<std::size_t>(s) * columns + 6 + k;
                q[at] = static_cast<float>(size * std::cos(phase));
                v[at] = static_cast<float>(-size * w * std::sin(phase));
            }
        float heard[ModalRun::kMost];
        float* const out[] = {heard};
        VoiceGains::pressure_flow(now, one, std::span(&ear, 1), allowance, out);
        if (run < 100)
            continue;
        for (int s = 0; s < samples; s += 7) {
            table.gains(turned(run * samples + s).transpose() * ear, gain);
            double exact = 0;
            for (std::size_t k = 0; k < modes; ++k) {
                const std::size_t at = static_cast<std::size_t>(s) * columns + 6 + k;
                exact +=
                    static_cast<double>(gain[k].velocity * q[at] + gain[k].acceleration * v[at]);
            }
            off += std::pow(static_cast<double>(heard[s]) - exact, 2);
            all += exact * exact;
        }
    }
    return 10 * std::log10(off / all);
}

// What a table costs an ear: looks are shared by all voices, and interpolated on straight lines.
TEST(VoiceGains, FollowABodyThatTumbles) {
    std::printf("%zu modes to 20 kHz, %zu numbers of the table a look\n", bar().mode.size(),
                bar().coefficient.size());
    double off[3][2][3];
    constexpr int kVoices[3] = {1, 10, 200};
    constexpr double kTurns[3] = {0.3, 1.0, 3.0};
    for (std::size_t v = 0; v < 3; ++v)
        for (std::size_t high = 0; high < 2; ++high) {
            std::printf("one of %d voices, two ears, to %d kHz; turns a second:", kVoices[v],
                        high ? 20 : 5);
            for (std::size_t t = 0; t < 3; ++t) {
                off[v][high][t] =
                    error(kTurns[t], high ? 12 : 5, VoiceGains::kAllowance / (2 * kVoices[v]));
                std::printf(" %g: %.1f dB", kTurns[t], off[v][high][t]);
            }
            std::printf("\n");
        }
    EXPECT_LT(off[0][0][0], -50);
    EXPECT_LT(off[0][0][1], -33);
    EXPECT_LT(off[0][1][0], -34);
    EXPECT_LT(off[1][0][0], -40);
    for (std::size_t high = 0; high < 2; ++high)
        for (std::size_t t = 0; t < 3; ++t)
            EXPECT_LT(off[2][high][t], 6) << "late, but no louder than it is";
}

} // namespace
} // namespace ode::sound
