// Oscillators that are struck: what they keep of a pulse, against what the pulse has.
#include "source/struck_voice.h"
#include "strike/pulse.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kRate = 48000.0;
constexpr std::array<double, 4> kHertz = {1e3, 5e3, 10e3, 20e3};
constexpr double kDecay = 20.0; // [1/s]

struct Nowhere final : BlockSink {
    void on_flow(const FlowBlock&) noexcept override {}
    void on_facets(const FacetBlock&) noexcept override {}
};

std::shared_ptr<const StruckVoiceModel> modes() {
    auto model = std::make_shared<StruckVoiceModel>();
    for (const double f : kHertz) {
        model->omega.push_back(2 * std::numbers::pi * f);
        model->decay.push_back(kDecay);
        model->level.push_back(1.0);
    }
    model->rigid.radius = 0.05;
    find_steps(*model, kRate);
    return model;
}

/// By how much each mode's velocity is off what the pulse leaves it, of what the same impulse at
/// once would: worst of 16 times within a sample that it begins at.
std::array<double, 4> images(double duration) {
    const auto model = modes();
    std::array<double, 4> worst{};
    for (int phase = 0; phase < 16; ++phase) {
        StruckVoice voice(model, kRate);
        Nowhere out;
        FramePose pose;
        pose.time = 0.01;
        voice.advance(pose, out);
        const double begin = 0.0102 + phase / 16.0 / kRate;
        const std::array<float, 4> push = {1, 1, 1, 1};
        voice.strike(begin, duration, push, RigidSound::Six::Zero());
        const double middle = begin + 0.5 * duration + model->rigid.radius / model->rigid.speed;
        for (int i = 0; i < 24; ++i) {
            pose.time = (std::ceil((middle + 0.5 * duration) * kRate) + 6 + i + 0.5) / kRate;
            voice.advance(pose, out);
            const double since = std::floor(pose.time * kRate) / kRate - middle;
            for (std::size_t k = 0; k < worst.size(); ++k) {
                const double w = 2 * std::numbers::pi * kHertz[k];
                const std::complex<double> s(-kDecay, std::sqrt(w * w - kDecay * kDecay));
                // The pulse's spectrum at the complex frequency, by parts.
                std::complex<double> felt = 0;
                constexpr int kParts = 2000;
                for (int j = 0; j < kParts; ++j) {
                    const double u = (j + 0.5) / kParts, half = 0.5 / kParts;
                    felt += (pulse_share(u + half) - pulse_share(u - half)) *
                            std::exp(-s * (u - 0.5) * duration);
                }
                const double exact = (s * felt * std::exp(s * since)).imag() / s.imag();
                worst[k] =
                    std::max(worst[k], std::fabs(static_cast<double>(voice.rates()[k]) - exact));
            }
        }
    }
    for (double& own : worst)
        own = 20 * std::log10(own);
    return worst;
}

// What a short pulse holds above half the rate must not come back below it.
TEST(StruckVoice, KeepsNoImageOfAShortPulse) {
    for (const double duration : {10e-6, 20e-6, 40e-6, 100e-6, 300e-6}) {
        const std::array<double, 4> db = images(duration);
        std::printf("pulse of %3.0f us, images: %.0f, %.0f, %.0f, %.0f dB at 1, 5, 10, 20 kHz\n",
                    1e6 * duration, db[0], db[1], db[2], db[3]);
        // Floats over as many steps; the spectrum's second order in what decays meanwhile. Longer
        // ones are as the spline leaves them.
        for (std::size_t k = 0; k < db.size(); ++k)
            EXPECT_LT(db[k], duration < 2e-4 ? -95 : k < 3 ? -80 : -60) << kHertz[k];
    }
}

} // namespace
} // namespace ode::sound
