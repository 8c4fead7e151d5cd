#include "base/error.h"
#include "mesh/jacobian.h"
#include "mesh/surface.h"
#include "shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <utility>

namespace ode::soft {
namespace {

class SurfaceOf : public testing::TestWithParam<test::Shape> {};
INSTANTIATE_TEST_SUITE_P(, SurfaceOf, testing::ValuesIn(test::all_shapes()), test::name_of);

double volume_of(const TetMesh& mesh) {
    double v = 0.0;
    for (std::size_t e = 0; e < mesh.element_count(); ++e)
        v += element_volume(mesh, e);
    return v;
}

TEST_P(SurfaceOf, RunsAlongEachEdgeOnceEitherWay) {
    std::map<std::pair<int, int>, int> runs;
    for (const auto& t : extract_surface(GetParam().mesh).triangle)
        for (std::size_t i = 0; i < 3; ++i)
            ++runs[{t[i], t[(i + 1) % 3]}];
    for (const auto& [edge, count] : runs) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(runs.contains({edge.second, edge.first}));
    }
}

TEST_P(SurfaceOf, HasTheEulerCharacteristicOfTheShape) {
    const Surface s = extract_surface(GetParam().mesh);
    const auto faces = static_cast<int>(s.triangle.size());
    EXPECT_EQ(static_cast<int>(s.node.size()) - faces * 3 / 2 + faces, GetParam().euler);
}

// Divergence theorem: a constant field has no net flux, and x / 3 has the flux V when the
// orientation is outward. Rounding: n triangles add n eps to sums of order surface and volume.
TEST_P(SurfaceOf, ObeysTheDivergenceTheorem) {
    const TetMesh& mesh = GetParam().mesh;
    Vec3 area = Vec3::Zero();
    double flux = 0.0;
    double total = 0.0;
    const Surface s = extract_surface(mesh);
    for (const auto& [i, j, k] : s.triangle) {
        const Vec3& a = mesh.node[static_cast<std::size_t>(i)];
        const Vec3& b = mesh.node[static_cast<std::size_t>(j)];
        const Vec3& c = mesh.node[static_cast<std::size_t>(k)];
        const Vec3 n = 0.5 * (b - a).cross(c - a);
        area += n;
        total += n.norm();
        flux += n.dot(a + b + c) / 9.0;
    }
    EXPECT_LT(area.norm(), 1e-13 * total);
    const double v = volume_of(mesh);
    EXPECT_GT(v, 0.0);
    EXPECT_NEAR(flux, v, 1e-12 * v);
}

TEST_P(SurfaceOf, ListsItsNodesOnceAscending) {
    const Surface s = extract_surface(GetParam().mesh);
    EXPECT_TRUE(std::is_sorted(s.node.begin(), s.node.end()));
    EXPECT_EQ(std::adjacent_find(s.node.begin(), s.node.end()), s.node.end());
    std::vector<int> used;
    for (const auto& t : s.triangle)
        used.insert(used.end(), t.begin(), t.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    EXPECT_EQ(s.node, used);
}

TetMesh quadratic_tetrahedron() {
    TetMesh mesh;
    mesh.order = 2;
    mesh.node = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const auto& [i, j] : kTetEdge)
        mesh.node.push_back(0.5 * (mesh.node[static_cast<std::size_t>(i)] +
                                   mesh.node[static_cast<std::size_t>(j)]));
    mesh.element.resize(10);
    std::iota(mesh.element.begin(), mesh.element.end(), 0);
    return mesh;
}

TEST(Surface, CutsAQuadraticFaceInFourOutwardTriangles) {
    const TetMesh mesh = quadratic_tetrahedron();
    const Surface s = extract_surface(mesh);
    ASSERT_EQ(s.triangle.size(), 16U);
    EXPECT_EQ(s.node.size(), 10U);
    for (const auto& [i, j, k] : s.triangle) {
        const Vec3& a = mesh.node[static_cast<std::size_t>(i)];
        const Vec3& b = mesh.node[static_cast<std::size_t>(j)];
        const Vec3& c = mesh.node[static_cast<std::size_t>(k)];
        const Vec3 n = 0.5 * (b - a).cross(c - a);
        // A quarter of the face 1/2 or sqrt(3)/2, away from the centre of the tetrahedron.
        EXPECT_GT(n.dot(a - Vec3::Constant(0.25)), 0.0);
        EXPECT_TRUE(std::abs(n.norm() - 0.125) < 1e-15 ||
                    std::abs(n.norm() - std::sqrt(3.0) / 8.0) < 1e-15);
    }
}

TEST(Surface, RefusesAFaceOfThreeElements) {
    TetMesh mesh;
    mesh.node = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}};
    mesh.element = {0, 1, 2, 3, 0, 2, 1, 4, 0, 1, 2, 5};
    try {
        extract_surface(mesh);
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("element 2 is the third on face 0 1 2"));
    }
}

} // namespace
} // namespace ode::soft
