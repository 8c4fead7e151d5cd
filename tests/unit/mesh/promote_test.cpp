#include "mesh/promote.h"

#include "mesh/quality.h"
#include "mesh/refine.h"
#include "mesh/surface.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

class Promoted : public testing::TestWithParam<test::Shape> {};
INSTANTIATE_TEST_SUITE_P(, Promoted, testing::ValuesIn(test::all_shapes()), test::name_of);

TEST_P(Promoted, KeepsCornersAndVolumeAndSharesMidEdgeNodes) {
    const TetMesh& linear = GetParam().mesh;
    const TetMesh mesh = promote_to_quadratic(linear);
    EXPECT_NO_THROW(check_mesh(mesh, "promoted")); // neighbours share their mid-edge nodes
    ASSERT_EQ(mesh.element_count(), linear.element_count());
    for (std::size_t i = 0; i < linear.node.size(); ++i)
        EXPECT_EQ(mesh.node[i], linear.node[i]);
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_EQ(n[c], linear.nodes_of(e)[c]);
        for (std::size_t i = 0; i < 6; ++i) {
            const Vec3& a = mesh.node[static_cast<std::size_t>(n[std::size_t(kTetEdge[i][0])])];
            const Vec3& b = mesh.node[static_cast<std::size_t>(n[std::size_t(kTetEdge[i][1])])];
            EXPECT_EQ(mesh.node[static_cast<std::size_t>(n[4 + i])], Vec3(0.5 * (a + b)));
        }
    }
    // V - E + F - C of a body equals its Euler characteristic, half that of its surface: the edges
    // are counted once each.
    const auto corners = static_cast<long>(linear.node.size());
    const auto edges = static_cast<long>(mesh.node.size()) - corners;
    const auto cells = static_cast<long>(linear.element_count());
    const auto outer = static_cast<long>(extract_surface(linear).triangle.size());
    EXPECT_EQ(corners - edges + (4 * cells + outer) / 2 - cells, GetParam().euler / 2);

    const double v = measure_quality(linear).volume;
    EXPECT_NEAR(measure_quality(mesh).volume, v, 1e-12 * v);
}

class Refined : public testing::TestWithParam<test::Shape> {};
INSTANTIATE_TEST_SUITE_P(, Refined, testing::ValuesIn(test::all_shapes()), test::name_of);

TEST_P(Refined, IsTheSameBodyInEightTimesTheElements) {
    const TetMesh& coarse = GetParam().mesh;
    const TetMesh mesh = refine_uniformly(coarse);
    EXPECT_NO_THROW(check_mesh(mesh, "refined"));
    ASSERT_EQ(mesh.element_count(), 8 * coarse.element_count());
    const MeshQuality q = measure_quality(mesh), q0 = measure_quality(coarse);
    EXPECT_NEAR(q.volume, q0.volume, 1e-12 * q0.volume);
    // The edges of these shapes are as short as the octahedra's diagonals. Coordinates round by
    // 1e-16 of at most 3, edges are at least 0.0025.
    EXPECT_NEAR(q.min_edge, 0.5 * q0.min_edge, 1e-12);
    EXPECT_EQ(extract_surface(mesh).triangle.size(), 4 * extract_surface(coarse).triangle.size());
}

// The right diagonal cuts Kuhn's tetrahedra into smaller copies of themselves.
TEST(Refine, KeepsQualityAndGroups) {
    TetMesh mesh = make_box({1, 1, 1}, 1, 1, 1);
    mesh.group = {0, 1, 2, 0, 1, 2};
    mesh.group_name = {"a", "b", "c"};
    const double quality = measure_quality(mesh).min_quality;
    const std::vector<int> group = mesh.group;
    for (int level = 0; level < 3; ++level)
        mesh = refine_uniformly(mesh);
    EXPECT_NEAR(measure_quality(mesh).min_quality, quality, 1e-12);
    EXPECT_EQ(mesh.group_name.size(), 3U);
    for (std::size_t e = 0; e < mesh.element_count(); ++e)
        EXPECT_EQ(mesh.group[e], group[e / 512]);
}

} // namespace
} // namespace ode::soft
