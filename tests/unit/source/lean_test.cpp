#include "source/lean.h"

#include "unit/transfer/shapes.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>

namespace ode::sound::test {
namespace {

/// A sphere's surface as sources hold it.
struct Ball {
    std::vector<int> triangle;
    AlignedVector point, area;

    explicit Ball(const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
        const BoundaryMesh mesh = sphere(2);
        for (const auto& t : mesh.triangle)
            triangle.insert(triangle.end(), t.begin(), t.end());
        const Surface surface(triangle);
        point.assign(4 * static_cast<std::size_t>(surface.nodes()), 0.0);
        for (int i = 0; i < surface.nodes(); ++i)
            for (int k = 0; k < 3; ++k)
                point[static_cast<std::size_t>(4 * i + k)] =
                    (turn * (0.1 * mesh.node[static_cast<std::size_t>(surface.body_node()[i])]))[k];
        area.assign(point.size(), 0.0);
        surface.areas(point.data(), area.data());
    }
    Lean lean(Leaning leaning) const {
        Lean made(leaning, Surface(triangle), point.data(), area.data(), 96000.0, 343.0);
        if (made.leans())
            made.aim(point.data(), area.data());
        return made;
    }
};

// Of a sphere the shift is a n / 2 everywhere: over its root mean square, n. The polyhedron is
// coarsened from 320 triangles to 300, which costs up to 5 % in places.
TEST(Lean, OfASphereIsItsNormal) {
    const Ball ball;
    for (const Leaning leaning : {Leaning::kNormal, Leaning::kCarried}) {
        const Lean lean = ball.lean(leaning);
        ASSERT_TRUE(lean.leans());
        for (std::size_t i = 0; i < ball.area.size(); i += 4) {
            const Eigen::Map<const Vec3> a(ball.area.data() + i), d(lean.direction() + i);
            if (a.norm() > 0.0) {
                EXPECT_LT((d - a.normalized()).norm(), 0.1);
            }
        }
    }
}

TEST(Lean, TurnsWithTheBodyAndIsSharedByLikeOnes) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Ball one, other(turn);
    const Lean a = one.lean(Leaning::kCarried), b = other.lean(Leaning::kCarried);
    for (std::size_t i = 0; i < one.point.size(); i += 4) {
        const Eigen::Map<const Vec3> from(a.direction() + i), to(b.direction() + i);
        EXPECT_LT((turn * from - to).norm(), 1e-9);
    }
}

TEST(Lean, OfAnOpenOrBrokenSurfaceIsNone) {
    Ball open;
    open.triangle.resize(open.triangle.size() - 3);
    EXPECT_FALSE(open.lean(Leaning::kCarried).leans());
    Ball broken;
    broken.point[5] = std::nan("");
    EXPECT_FALSE(broken.lean(Leaning::kCarried).leans());
    EXPECT_FALSE(Ball().lean(Leaning::kNone).leans());
}

// i w T / (1 + i w T) with T = a / 2c for shaking and a / c for pulsation.
TEST(Lean, IsHighPassedByTheBodysLength) {
    const Ball ball;
    Lean lean = ball.lean(Leaning::kCarried);
    const auto nodes = ball.point.size() / 4;
    for (const bool pulsates : {true, false}) {
        lean.reset();
        const double w = 2.0 * M_PI * 500.0, rate = 96000.0;
        const double time = (pulsates ? 0.1 : 0.05) / 343.0;
        std::vector<double> shape(nodes), flow(nodes);
        for (std::size_t i = 0; i < nodes; ++i) {
            const Eigen::Map<const Vec3> a(ball.area.data() + 4 * i);
            shape[i] = pulsates ? a.norm() : a[2];
        }
        double most = 0.0;
        for (int n = 0; n < 9600; ++n) {
            for (std::size_t i = 0; i < nodes; ++i)
                flow[i] = shape[i] * std::sin(w * n / rate);
            lean.follow(flow.data());
            for (std::size_t i = 0; n > 4800 && i < nodes; ++i)
                if (shape[i] > 1e-5)
                    most = std::max(most, lean.flow()[i] / shape[i]);
        }
        EXPECT_NEAR(most, w * time / std::hypot(1.0, w * time), 0.03);
    }
}

} // namespace
} // namespace ode::sound::test
