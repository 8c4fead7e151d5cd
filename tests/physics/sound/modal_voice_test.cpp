// Bodies that move in their modes, heard through the table of how these sound.
#include "physics/sound/rig.h"
#include "transfer/transfer_table.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace ode::sound::test {
namespace {

constexpr double kRadius = 0.05, kFrequency = 1000.0, kAmplitude = 1e-6, kDistance = 1.0;
/// Pressure at 1 m per acceleration where a sphere pulsates (Pierce, Acoustics, 4-1).
const double kLevel =
    Air{}.density * kRadius * kRadius / std::hypot(1.0, kTau* kFrequency / Air{}.speed * kRadius);

/// A sphere whose one mode is to pulsate, or to shake along z, 1 m for unit amplitude.
std::shared_ptr<const ModalVoiceModel> sphere(double decay, bool shakes) {
    const Shape shape = make_sphere(2);
    ModalSurface surface;
    for (const auto& x : shape.node) {
        surface.mesh.node.emplace_back(kRadius * x);
        for (int k = 0; k < 3; ++k)
            surface.shape.push_back(shakes ? (k == 2 ? 1.0 : 0.0) : x[k]);
    }
    for (std::size_t t = 0; t + 2 < shape.triangle.size(); t += 3)
        surface.mesh.triangle.push_back(
            {shape.triangle[t], shape.triangle[t + 1], shape.triangle[t + 2]});
    surface.frequency = {kFrequency};
    ModalVoiceModel model;
    model.omega = {kTau * kFrequency};
    model.decay = {decay};
    model.table = make_transfer_table(surface);
    model.level = {kLevel};
    return std::make_shared<const ModalVoiceModel>(std::move(model));
}

/// What is heard at kDistance of views `step` [s] apart. @param until  views end there [s].
/// @param spin  about y [rad/s]; a sphere that spins shakes, one that doesn't pulsates.
/// @param count  out, or null.
std::vector<double> listen(double step, double until, double time, double spin = 0.0,
                           double distance = kDistance, Scene::Count* count = nullptr) {
    Settings settings = Rig::unit_settings();
    settings.radiation = Radiation::kTransfer;
    const auto model = sphere(0.0, spin != 0.0);
    const auto recorder = std::make_shared<Recorder>();
    Scene scene;
    scene.set(settings);
    Listener& listener = scene.add_listener(0.0);
    listener.pose.centre = Vec3(distance, 0.0, 0.0);
    listener.pose.ear_distance = 0.0;
    listener.add_sink(recorder);
    const int triangle[3] = {0, 0, 0};
    const double w = kTau * kFrequency;
    for (int i = 1; i * step < time + 0.5 * step; ++i) {
        const double t = i * step;
        const double q = kAmplitude * std::cos(w * t), v = -w * kAmplitude * std::sin(w * t);
        if (t <= until + 0.5 * step)
            scene.push(&scene, triangle,
                       ModalView{t,
                                 step,
                                 {&q, 1},
                                 {&v, 1},
                                 Vec3::Zero(),
                                 Eigen::AngleAxisd(spin * t, Vec3::UnitY()).toRotationMatrix()},
                       [&] { return model; });
        scene.end_step(t);
    }
    if (count)
        *count = scene.count();
    return recorder->ear[0];
}

// p = i w rho a^2 v e^{-ik(r-a)} / (r (1 + ika)) (Pierce, Acoustics, 4-1).
TEST(ModalVoice, OfAPulsatingSphereIsTheClosedForm) {
    const std::vector<double> heard = listen(1e-3, 1.0, 0.1);
    const double w = kTau * kFrequency, k = w / Air{}.speed;
    const double expected = Air{}.density * w * w * kAmplitude * kRadius * kRadius /
                            (kDistance * std::hypot(1.0, k * kRadius));
    // Past the way and the fade: the sum of a cosine and a sine.
    const std::size_t from = 48 * 15, count = 48 * 50;
    double c = 0.0, s = 0.0, left = 0.0;
    for (std::size_t i = from; i < from + count; ++i) {
        const double phase = w * static_cast<double>(i) / 48000.0;
        c += 2.0 * heard[i] * std::cos(phase) / count;
        s += 2.0 * heard[i] * std::sin(phase) / count;
    }
    for (std::size_t i = from; i < from + count; ++i) {
        const double phase = w * static_cast<double>(i) / 48000.0;
        left += std::pow(heard[i] - c * std::cos(phase) - s * std::sin(phase), 2);
    }
    EXPECT_NEAR(20.0 * std::log10(std::hypot(c, s) / expected), 0.0, 0.5);
    // q'' = -w^2 A cos(wt) a radius early: the phase of e^{-ik(r-a)} / (1 + ika).
    const std::complex<double> wave =
        -std::polar(1.0, -k * (kDistance - kRadius)) / std::complex<double>(1.0, k * kRadius);
    const double off = std::arg(std::complex<double>(c, -s) / wave);
    EXPECT_LT(std::fabs(off), 0.03);
    EXPECT_LT(10.0 * std::log10(left / (count * 0.5 * (c * c + s * s))), -80.0);
}

// Between views the mode rings by itself: how far apart they are is not to be heard.
TEST(ModalVoice, DoesNotHearHowFarApartViewsAre) {
    const std::vector<double> rare = listen(5e-3, 1.0, 0.05), often = listen(2e-5, 1.0, 0.05);
    const std::size_t n = std::min(rare.size(), often.size());
    double off = 0.0, all = 0.0;
    for (std::size_t i = 48 * 20; i < n; ++i) {
        off += std::pow(rare[i] - often[i], 2);
        all += std::pow(often[i], 2);
    }
    ASSERT_GT(all, 0.0);
    EXPECT_LT(10.0 * std::log10(off / all), -80.0);
}

// A body that spins by a tenth of a radian from view to view is not heard to turn by jerks, as a
// buzz at the rate of the views: a dipole that goes round, its ear in the plane.
TEST(ModalVoice, DoesNotHearATurnByItsViews) {
    const double spin = 20.0;
    const std::vector<double> rare = listen(5e-3, 1.0, 0.1, spin),
                              often = listen(1e-4, 1.0, 0.1, spin);
    const std::size_t n = std::min(rare.size(), often.size());
    double off = 0.0, all = 0.0;
    for (std::size_t i = 48 * 20; i < n; ++i) {
        off += std::pow(rare[i] - often[i], 2);
        all += std::pow(often[i], 2);
    }
    ASSERT_GT(all, 0.0);
    EXPECT_LT(10.0 * std::log10(off / all), -80.0);
}

// A mode is left out where its pressure is less than that of no sound, and nowhere else.
TEST(ModalVoice, LeavesOutWhatNoEarHears) {
    const double acceleration = kTau * kFrequency * kTau * kFrequency * kAmplitude;
    const double just = kLevel * acceleration / kInaudible; // [m]
    Scene::Count near{}, far{};
    const std::vector<double> heard = listen(1e-3, 0.1, 0.1, 0.0, 0.9 * just, &near);
    EXPECT_GT(near.mode_samples, 9000U);
    EXPECT_EQ(near.inaudible_samples, 0U);
    const std::vector<double> silent = listen(1e-3, 0.1, 0.1, 0.0, 1.2 * just, &far);
    EXPECT_EQ(far.mode_samples, 0U);
    EXPECT_EQ(far.inaudible_samples, near.mode_samples);
    EXPECT_TRUE(std::all_of(silent.begin(), silent.end(), [](double p) { return p == 0.0; }));
}

// Where views break off the mode is faded, not cut.
TEST(ModalVoice, EndsWithoutAClick) {
    const std::vector<double> heard = listen(1e-3, 0.03, 0.1);
    const auto peak = [&](std::size_t from, std::size_t to) {
        double most = 0.0;
        for (std::size_t i = from; i < std::min(to, heard.size()); ++i)
            most = std::max(most, std::fabs(heard[i]));
        return most;
    };
    const double ringing = peak(48 * 15, 48 * 30);
    EXPECT_GT(ringing, 0.0);
    // The way is 3 ms, the fade 5 ms; its slope is some thousandth of the ring's.
    EXPECT_LT(peak(48 * 33, 48 * 40), 1.1 * ringing);
    EXPECT_LT(peak(48 * 45, 48 * 100), 1e-6 * ringing);
}

} // namespace
} // namespace ode::sound::test
