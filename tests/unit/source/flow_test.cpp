#include "source/flow_fade.h"
#include "source/flow_history.h"
#include "source/place_history.h"
#include "source/radiation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kSpacing = 1.0 / 96000.0;

// However the intervals vary, a constant velocity is constant: the steps telescope.
TEST(FlowHistory, ConstantFlowPassesExactlyThroughUnevenIntervals) {
    FlowHistory history(4, 200);
    double t = 0.0;
    for (int i = 0; i < 150; ++i) {
        const double dt = kSpacing * (0.1 + 0.3 * (i * 7 % 5));
        double* volume = history.push(t, t + dt, false);
        for (int k = 0; k < 4; ++k)
            volume[k] = (k + 1) * dt;
        t += dt;
    }
    AlignedVector out(16);
    double* const flow[4] = {out.data(), out.data() + 4, out.data() + 8, out.data() + 12};
    ASSERT_TRUE(history.low_pass(0.5 * t, kSpacing, 1.0, flow));
    for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k)
            EXPECT_NEAR(flow[j][k], k + 1.0, 1e-13);
}

TEST(FlowHistory, ToneKeepsAmplitudeAndPhase) {
    const double f = 10000.0, w = 2.0 * std::numbers::pi * f, dt = kSpacing / 4.0;
    FlowHistory history(4, 200);
    for (int i = 0; i < 160; ++i) {
        const double a = i * dt, b = (i + 1) * dt;
        double* volume = history.push(a, b, false);
        std::fill_n(volume, 4, (std::sin(w * b) - std::sin(w * a)) / w); // flow cos(wt)
    }
    AlignedVector out(16);
    double* const flow[4] = {out.data(), out.data() + 4, out.data() + 8, out.data() + 12};
    const double first = 80.0 * dt;
    ASSERT_TRUE(history.low_pass(first, kSpacing, 1.0, flow));
    const double box = std::sin(0.5 * w * dt) / (0.5 * w * dt);
    for (int j = 0; j < 4; ++j)
        EXPECT_NEAR(flow[j][0], box * box * std::cos(w * (first + j * kSpacing)), 2e-5);
}

TEST(FlowHistory, QuietIntervalsNeedNoWork) {
    FlowHistory history(4, 50);
    AlignedVector out(16, 5.0);
    double* const flow[4] = {out.data(), out.data() + 4, out.data() + 8, out.data() + 12};
    EXPECT_FALSE(history.low_pass(0.0, kSpacing, 1.0, flow));
    std::fill_n(history.push(0.0, 1e-5, true), 4, 0.0);
    EXPECT_FALSE(history.low_pass(0.0, kSpacing, 1.0, flow));
    EXPECT_EQ(out[0], 5.0);
}

TEST(FlowHistory, GrowsWithoutForgetting) {
    FlowHistory history(4, 3);
    for (int i = 0; i < 5; ++i)
        history.push(i, i + 1.0, false)[0] = i;
    history.reserve(9);
    ASSERT_EQ(history.size(), 3);
    for (int age = 0; age < 3; ++age)
        EXPECT_EQ(history.volume(age)[0], 4.0 - age);
    history.push(5.0, 6.0, false)[0] = 5.0;
    EXPECT_EQ(history.volume(1)[0], 4.0);
    EXPECT_EQ(history.size(), 4);
}

TEST(FlowFade, BeginsWithValueAndSlopeAndEndsAtRest) {
    FlowFade fade(4);
    fade.value()[0] = 2.0;
    fade.slope()[1] = 3.0;
    fade.begin(0.0);
    const auto flow = [&](double t, int node) {
        const double dt = 1e-9;
        double volume[4] = {};
        fade.add(t, t + dt, volume);
        return volume[node] / dt;
    };
    EXPECT_NEAR(flow(0.0, 0), 2.0, 1e-9);
    EXPECT_NEAR((flow(1e-7, 1) - flow(0.0, 1)) / 1e-7, 3.0, 1e-2);
    EXPECT_NEAR(flow(FlowFade::kValueTime, 0), 0.0, 1e-9);
    EXPECT_NEAR(flow(FlowFade::kSlopeTime, 1), 0.0, 1e-12);
    EXPECT_TRUE(fade.is_active(0.001));
    EXPECT_FALSE(fade.is_active(FlowFade::kValueTime));
}

TEST(FlowFade, NothingToFadeIsInactive) {
    FlowFade fade(4);
    fade.begin(0.0);
    EXPECT_FALSE(fade.is_active(0.0));
}

TEST(PlaceHistory, GhostFadesFromOneToNothing) {
    PlaceHistory places(4, 8);
    const AlignedVector from(16, 3.0);
    EXPECT_EQ(places.ghost_share(5), 0.0);
    places.jump(from.data(), 5, 100);
    EXPECT_EQ(places.ghost_share(4), 0.0);
    EXPECT_EQ(places.ghost_share(5), 1.0);
    EXPECT_NEAR(places.ghost_share(55), 0.5, 1e-12);
    EXPECT_EQ(places.ghost_share(105), 0.0);
    EXPECT_EQ(places.ghost()[7], 3.0);
}

TEST(PlaceHistory, SlotsOfNegativeSamplesAreDistinct) {
    PlaceHistory places(4, 8);
    for (int o = -5; o < 3; ++o)
        places.at(o)[0] = o;
    places.set_newest(2);
    places.reserve(20);
    for (int o = -5; o < 3; ++o)
        EXPECT_EQ(places.at(o)[0], o);
}

TEST(Radiation, NamesRoundTrip) {
    Radiation radiation = Radiation::kPaper;
    for (int i = 0; !radiation_name(i).empty(); ++i) {
        ASSERT_TRUE(find_radiation(radiation_name(i), radiation));
        EXPECT_EQ(static_cast<int>(radiation), i);
    }
    EXPECT_FALSE(find_radiation("loud", radiation));
    EXPECT_EQ(radiation_name(5), "");
}

} // namespace
} // namespace ode::sound
