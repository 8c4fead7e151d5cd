#include "model/rotation_lanes.h"

#include "base/types.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace ode::soft {
namespace {

Mat3 nearest(const Mat3& matrix) {
    double f[3][3], r[3][3];
    for (int i = 0; i < 9; ++i)
        f[i / 3][i % 3] = matrix(i / 3, i % 3);
    scalar::nearest_rotation<scalar::Lane<1>>(f, matrix.squaredNorm(), r);
    Mat3 out;
    for (int i = 0; i < 9; ++i)
        out(i / 3, i % 3) = r[i / 3][i % 3];
    return out;
}

// F = R S with S symmetric positive definite has the nearest rotation R: no second method needed.
// The eigenvector loses digits with the gap, which is 2 (sum of the two smallest stretches).
TEST(NearestRotation, IsThePolarFactorAtAnyTurnAndStretch) {
    std::mt19937 bits(5);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> log_stretch(std::log(0.1), std::log(10.0));
    double worst = 0;
    for (int n = 0; n < 20000; ++n) {
        Vec3 axis(normal(bits), normal(bits), normal(bits));
        const double angle =
            n % 4 == 0 ? std::numbers::pi : std::numbers::pi * (1 - std::pow(10.0, -(n % 14)));
        const Mat3 r = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
        const Mat3 q = Quat(normal(bits), normal(bits), normal(bits), normal(bits))
                           .normalized()
                           .toRotationMatrix();
        const Vec3 stretch = Vec3::NullaryExpr([&] { return std::exp(log_stretch(bits)); });
        const Mat3 s = q * stretch.asDiagonal() * q.transpose();
        const double gap = 2 * (stretch.sum() - stretch.maxCoeff()) / stretch.maxCoeff();
        worst = std::max(worst, (nearest(r * s) - r).norm() * std::pow(std::min(gap, 1.0), 3));
    }
    EXPECT_LE(worst, 1e-13);
}

TEST(NearestRotation, OfAnInvertedElementIsARotation) {
    const Mat3 f = Vec3(-0.4, 0.9, 1.2).asDiagonal();
    EXPECT_LE((nearest(f) - Mat3::Identity()).norm(), 1e-12); // least stretch turns negative
    const Mat3 squashed = Vec3(1, 1, 0).asDiagonal();
    EXPECT_LE((nearest(squashed) - Mat3::Identity()).norm(), 1e-12);
    EXPECT_TRUE(nearest(Mat3::Zero()).allFinite());
}

} // namespace
} // namespace ode::soft
