#include "listen/pose.h"

#include <gtest/gtest.h>

namespace ode::sound {
namespace {

constexpr double kRate = 96000.0;

TEST(EarPath, StandsStill) {
    EarPath path(kRate, {1.0, 2.0, 3.0});
    path.move_to({1.0, 2.0, 3.0}, 500, 1600);
    EXPECT_TRUE(path.is_still());
    EXPECT_EQ(path.at(700).position, Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(path.at(700).ghost_share, 0.0);
}

TEST(EarPath, MovesInAStraightLineAndComesToRest) {
    EarPath path(kRate, Vec3::Zero());
    path.move_to({0.16, 0.0, 0.0}, 1000, 1600);
    EXPECT_EQ(path.at(1000).position[0], 0.0);
    EXPECT_NEAR(path.at(1800).position[0], 0.08, 1e-12);
    EXPECT_EQ(path.at(2600).position[0], 0.16);
    EXPECT_NEAR(path.at(1400).position[0], 0.04, 1e-12) << "earlier samples may be asked for";
    EXPECT_EQ(path.at(96000).position[0], 0.16);
    EXPECT_TRUE(path.is_still());
    EXPECT_EQ(path.at(96000).velocity, Vec3::Zero().eval());
}

TEST(EarPath, VelocityOfSteadyMotionIsExactInTheEnd) {
    EarPath path(kRate, Vec3::Zero());
    for (int step = 0; step < 60; ++step)
        path.move_to({0.1 * (step + 1), 0.0, 0.0}, 960 * step, 960); // 10 m/s
    const auto& state = path.at(960 * 60);
    // 0.6 s are twelve smoothing times: e^-12 of 10 m/s is missing.
    EXPECT_NEAR(state.velocity[0], 10.0, 1e-4);
    EXPECT_NEAR(state.position[0], 6.0, 1e-9);
}

TEST(EarPath, JumpCrossesOver) {
    EarPath path(kRate, Vec3::Zero());
    path.move_to({50.0, 0.0, 0.0}, 100, 1600);
    const EarPath::State begin = path.at(101);
    EXPECT_EQ(begin.position[0], 50.0);
    EXPECT_EQ(begin.ghost[0], 0.0);
    EXPECT_NEAR(begin.ghost_share, 1.0, 1e-5);
    EXPECT_NEAR(path.at(901).ghost_share, 0.5, 1e-3);
    EXPECT_EQ(path.at(1800).ghost_share, 0.0);
}

TEST(Pose, EarsLieOnAtCrossUp) {
    Pose pose;
    pose.centre = {1.0, 1.0, 1.0};
    ASSERT_TRUE(pose.orient({0.0, 3.0, 0.0}, {0.0, 0.1, 2.0})); // any length, not orthogonal
    EXPECT_LT((pose.ears()[1] - Vec3(1.1, 1.0, 1.0)).norm(), 1e-15);
    EXPECT_LT((pose.ears()[0] - Vec3(0.9, 1.0, 1.0)).norm(), 1e-15);
}

TEST(Pose, ParallelOrEmptyDirectionsAreRefused) {
    Pose pose;
    EXPECT_FALSE(pose.orient({0.0, 1.0, 0.0}, {0.0, -2.0, 0.0}));
    EXPECT_FALSE(pose.orient({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}));
    EXPECT_FALSE(pose.orient({std::nan(""), 0.0, 0.0}, {0.0, 1.0, 0.0}));
    EXPECT_EQ(pose.right, Vec3::UnitX().eval());
}

} // namespace
} // namespace ode::sound
