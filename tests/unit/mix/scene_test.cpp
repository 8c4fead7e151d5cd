#include "physics/sound/rig.h"

#include <gtest/gtest.h>

namespace ode::sound::test {
namespace {

TEST(Meter, PeakAndRms) {
    Meter meter, other;
    for (const double v : {1.0, -3.0, 2.0})
        meter.add(v);
    other.add(4.0);
    meter.add(other);
    EXPECT_EQ(meter.peak(), 4.0);
    EXPECT_DOUBLE_EQ(meter.rms(), std::sqrt(30.0 / 4.0));
    EXPECT_EQ(Meter{}.rms(), 0.0);
}

TEST(Settings, LatencyIsTwoMilliseconds) {
    Settings s;
    const std::int64_t frame = s.first_open_frame(1.0);
    EXPECT_LT(frame, 48000);
    EXPECT_GT(frame, 48000 - 106); // 2.2 ms
    Sampling sampling = Sampling::kSinc;
    EXPECT_TRUE(find_sampling("paper", sampling));
    EXPECT_EQ(sampling, Sampling::kPaper);
    EXPECT_FALSE(find_sampling("cubic", sampling));
}

TEST(Scene, AllSinksOfAListenerGetTheSameBits) {
    Rig rig;
    auto second = std::make_shared<Recorder>();
    ASSERT_TRUE(rig.listener->add_sink(second));
    ASSERT_TRUE(rig.listener->add_sink(second)) << "twice is once";
    rig.listener->pose.centre = {0.0, 0.2, 0.0};
    rig.add(make_sphere(0), pulsate(0.01, 1e-3, 500.0));
    rig.run(0.02);
    EXPECT_EQ(rig.recorder.ear[0], second->ear[0]);
    EXPECT_EQ(rig.recorder.ear[1], second->ear[1]);
    rig.listener->remove_sink(*second);
    const std::size_t had = second->ear[0].size();
    rig.run(0.02);
    EXPECT_EQ(second->ear[0].size(), had);
    ASSERT_TRUE(rig.listener->add_sink(second));
    second.reset(); // the caller lets it go: so does the listener
    rig.run(0.02);
    int left = 0;
    rig.listener->for_each_sink([&](const Sink&) { ++left; });
    EXPECT_EQ(left, 1);
}

TEST(Scene, GainOfABodyIsAFactorAndMutesWithoutAClick) {
    const double frequency = 500.0;
    Rig rig;
    rig.listener->pose.centre = {0.0, 0.2, 0.0};
    rig.listener->pose.ear_distance = 0.0;
    const int body = rig.add(make_sphere(0), pulsate(0.01, 1e-3, frequency));
    rig.run(0.05);
    rig.set_gain(body, 0.5);
    rig.run(0.05);
    rig.set_gain(body, 0.0);
    rig.run(0.05);
    const unsigned long gathers = rig.scene.count().gathers;
    rig.run(0.05);
    EXPECT_EQ(rig.scene.count().gathers, gathers) << "a muted body costs nothing";
    rig.set_gain(body, 1.0);
    rig.run(0.1);
    const auto level = [&](double begin, double end) {
        return std::abs(phasor(rig.heard(begin, end), rig.rate(), frequency));
    };
    const double whole = level(0.02, 0.05);
    EXPECT_NEAR(level(0.065, 0.095) / whole, 0.5, 1e-3);
    EXPECT_LT(level(0.165, 0.195) / whole, 1e-9);
    EXPECT_NEAR(level(0.25, 0.29) / whole, 1.0, 1e-3);
    // Above 10 kHz a tone of 500 Hz has nothing, a click has.
    EXPECT_LT(decibel(band_rms(rig.heard(0.02, 0.29), rig.rate(), 10000.0, 20000.0) / whole),
              -60.0);
}

TEST(Scene, MetersShowEachEarSinceTheLastLook) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 0.2, 0.0};
    rig.add(make_sphere(0), pulsate(0.01, 1e-3, 500.0, {0.09, 0.2, 0.0}));
    rig.run(0.05);
    const Listener::Level level = rig.listener->take_level();
    EXPECT_GT(level.ear[1].peak(), 2.0 * level.ear[0].peak());
    EXPECT_EQ(level.least_gain, 1.0);
    EXPECT_EQ(rig.listener->take_level().ear[1].peak(), 0.0);
    rig.listener->set_limiter(0.1 * level.ear[1].peak());
    rig.run(0.05);
    EXPECT_NEAR(rig.listener->take_level().least_gain, 0.1, 0.02);
    const std::vector<double> held = rig.heard(0.07, 0.095, 1);
    EXPECT_LE(*std::max_element(held.begin(), held.end()), 0.1 * level.ear[1].peak() + 1e-9);
}

/// Takes a few frames at a time, then no more.
class Narrow final : public Sink {
public:
    bool open(const Format&) override { return true; }
    std::size_t write(std::span<const float> interleaved) noexcept override {
        const std::size_t now = std::min({interleaved.size() / 2, std::size_t{10}, left});
        left -= now;
        return now;
    }
    void close() noexcept override {}
    const char* error() const noexcept override { return ""; }
    const char* kind() const noexcept override { return "narrow"; }
    std::size_t left = 300;
};

TEST(Scene, FullSinkDropsFramesAndBlocksNobody) {
    Rig rig;
    const auto narrow = std::make_shared<Narrow>();
    rig.listener->add_sink(narrow);
    rig.run(0.02);
    EXPECT_EQ(narrow->left, 0u);
    EXPECT_EQ(rig.listener->dropped(), rig.listener->frames() - 300);
    EXPECT_EQ(rig.recorder.ear[0].size(), static_cast<std::size_t>(rig.listener->frames()));
}

TEST(Scene, FullScaleScalesTheRecordingAlone) {
    const auto run = [](double full_scale) {
        Settings settings = Rig::unit_settings();
        settings.full_scale = full_scale;
        Rig rig(settings);
        rig.listener->pose.centre = {0.0, 0.2, 0.0};
        rig.add(make_sphere(0), pulsate(0.01, 1e-3, 500.0));
        rig.run(0.02);
        return std::pair(rig.recorder.ear[0].at(700), rig.scene.count().peak);
    };
    const auto [unit, unit_peak] = run(1.0);
    const auto [scaled, scaled_peak] = run(8.0);
    EXPECT_EQ(scaled, unit / 8.0); // a power of two: exact
    EXPECT_EQ(unit_peak, scaled_peak);
    EXPECT_GT(unit_peak, 0.0);
}

TEST(Scene, SubstepsAreGatheredEightTimesASample) {
    Rig rig(Rig::unit_settings(), 0.5e-6);
    rig.add(make_sphere(0), pulsate(0.01, 1e-3, 500.0));
    rig.run(0.02);
    const Scene::Count count = rig.scene.count();
    EXPECT_EQ(count.substeps, 40000u);
    EXPECT_NEAR(static_cast<double>(count.gathers), 0.02 * 8.0 * 48000.0, 500.0);
    EXPECT_EQ(count.frames, static_cast<unsigned long>(rig.listener->frames()));
}

TEST(Scene, ModelsMayChangeAtAnyTime) {
    Rig rig;
    rig.listener->pose.centre = {0.0, 0.2, 0.0};
    rig.add(make_sphere(0), pulsate(0.01, 1e-3, 500.0));
    for (const Radiation radiation :
         {Radiation::kRayleigh, Radiation::kPaper, Radiation::kMonopole})
        for (const Sampling sampling : {Sampling::kPaper, Sampling::kSinc}) {
            Settings settings = rig.scene.settings();
            settings.radiation = radiation;
            settings.sampling = sampling;
            rig.scene.set(settings);
            rig.run(0.02);
        }
    EXPECT_NEAR(static_cast<double>(rig.recorder.ear[0].size()), 0.12 * 48000.0, 110.0);
    for (const double v : rig.recorder.ear[0])
        ASSERT_TRUE(std::isfinite(v));
    EXPECT_GT(rig.scene.count().peak, 0.0);
}

TEST(Scene, ListenersComeAndGo) {
    Rig rig;
    rig.add(make_sphere(0), pulsate(0.01, 1e-3, 500.0));
    rig.run(0.02);
    const auto late = std::make_shared<Recorder>();
    Listener& second = rig.scene.add_listener(rig.time());
    second.add_sink(late);
    second.pose.centre = {0.0, 0.3, 0.0};
    rig.run(0.02);
    EXPECT_NEAR(static_cast<double>(late->ear[0].size()), 0.02 * 48000.0, 110.0);
    const unsigned long frames = rig.scene.count().frames;
    rig.scene.remove_listener(second);
    EXPECT_EQ(rig.scene.count().frames, frames) << "what was rendered stays counted";
    rig.run(0.02);
    rig.scene.remove_listener(*rig.listener);
    EXPECT_EQ(rig.scene.listeners(), 0u);
    EXPECT_GT(rig.scene.count().peak, 0.0);
}

} // namespace
} // namespace ode::sound::test
