#include "couple/soft_surface.h"
#include "mesh/generate.h"
#include "mesh/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ode::soft {
namespace {

struct Body {
    explicit Body(TetMesh of)
        : mesh(std::move(of)), surface(extract_surface(mesh)), mass(mesh.node.size(), 0.1),
          nodes(mesh, surface, mass), soft(nodes, mesh.node), position(mesh.node.size()) {
        for (std::size_t i = 0; i < mesh.node.size(); ++i)
            position[i] = mesh.node[i];
    }
    TetMesh mesh;
    Surface surface;
    std::vector<double> mass;
    SurfaceNodes nodes;
    SoftSurface soft;
    NodeArray position;
};

double sum(std::span<const SurfacePoint> points, double SurfacePoint::*what) {
    return std::accumulate(points.begin(), points.end(), 0.0,
                           [&](double s, const SurfacePoint& p) { return s + p.*what; });
}

bool is_middle(const SurfacePoint& p) { return p.weight[1] != 0; }

TEST(SoftSurface, SharesOutAreaAndMass) {
    const Body cube(make_box({0.2, 0.2, 0.2}, 2, 2, 2));
    EXPECT_NEAR(sum(cube.soft.points(), &SurfacePoint::area), 6 * 0.04, 1e-12);
    const double all = 0.1 * static_cast<double>(cube.nodes.node.size());
    EXPECT_LE(sum(cube.soft.points(), &SurfacePoint::mass), all * (1 + 1e-12));
    for (const SurfacePoint& p : cube.soft.points()) {
        EXPECT_NEAR(p.weight[0] + p.weight[1], 1, 1e-15);
        EXPECT_GT(p.area, 0);
        EXPECT_GT(p.mass, 0);
    }
}

// A cube of two cells a side has twelve edges of two segments; its flat faces have no crease.
TEST(SoftSurface, PutsPointsOnTheMiddlesOfConvexCreasesAlone) {
    const Body cube(make_box({0.2, 0.2, 0.2}, 2, 2, 2));
    int middles = 0;
    for (const SurfacePoint& p : cube.soft.points()) {
        if (!is_middle(p))
            continue;
        ++middles;
        const Vec3 x = p.in(cube.position);
        const auto on_side = (x.array().abs() > 0.1 - 1e-12).count();
        EXPECT_EQ(on_side, 2) << x.transpose();
    }
    EXPECT_EQ(middles, 24);
    const auto nodes = std::count_if(cube.soft.points().begin(), cube.soft.points().end(),
                                     [](const SurfacePoint& p) { return !is_middle(p); });
    EXPECT_EQ(nodes, static_cast<long>(cube.nodes.node.size()));
}

// A ball of many facets turns by less than 30 degrees at each edge.
TEST(SoftSurface, FindsNoCreaseOnARoundBody) {
    const Body ball(make_sphere(0.1, 4));
    for (const SurfacePoint& p : ball.soft.points())
        EXPECT_FALSE(is_middle(p));
}

TEST(SoftSurface, TreeFollowsTheBodyWhenRefitted) {
    Body cube(make_box({0.2, 0.2, 0.2}, 2, 2, 2));
    for (std::size_t i = 0; i < cube.position.size(); ++i)
        cube.position[i] += Vec3(1, 0, 0);
    cube.soft.refit(cube.position, 1);
    EXPECT_NEAR(cube.soft.tree().bounds().low.x(), 0.9, 1e-12);
    for (std::size_t i = 0; i < cube.position.size(); ++i)
        cube.position[i] += Vec3(1, 0, 0);
    cube.soft.refit(cube.position, 1); // the same moment by its name: nothing is done
    EXPECT_NEAR(cube.soft.tree().bounds().low.x(), 0.9, 1e-12);
    cube.soft.refit(cube.position, 2);
    EXPECT_NEAR(cube.soft.tree().bounds().low.x(), 1.9, 1e-12);
}

} // namespace
} // namespace ode::soft
