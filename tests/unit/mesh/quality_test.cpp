#include "mesh/quality.h"

#include "base/error.h"
#include "mesh/generate.h"
#include "mesh/jacobian.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace ode::soft {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TetMesh corner_tetrahedron() {
    TetMesh mesh;
    mesh.node = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.element = {0, 1, 2, 3};
    return mesh;
}

TetMesh quadratic_tetrahedron() {
    TetMesh mesh = corner_tetrahedron();
    mesh.order = 2;
    for (const auto& [i, j] : kTetEdge)
        mesh.node.push_back(0.5 * (mesh.node[static_cast<std::size_t>(i)] +
                                   mesh.node[static_cast<std::size_t>(j)]));
    mesh.element.resize(10);
    std::iota(mesh.element.begin(), mesh.element.end(), 0);
    return mesh;
}

std::string refusal(const TetMesh& mesh) {
    try {
        check_mesh(mesh, "tet");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Quality, IsOneForARegularTetrahedronAndForgetsSizeAndPlace) {
    TetMesh mesh;
    mesh.node = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.element = {0, 2, 1, 3};
    if (element_volume(mesh, 0) < 0.0)
        std::swap(mesh.element[1], mesh.element[2]);
    EXPECT_NEAR(element_quality(mesh, 0), 1.0, 1e-15);
    for (Vec3& x : mesh.node)
        x = 1e-3 * x + Vec3(5.0, 0.0, 0.0);
    EXPECT_NEAR(element_quality(mesh, 0), 1.0, 1e-11); // 5 eps / 1e-3
    std::swap(mesh.element[1], mesh.element[2]);
    EXPECT_NEAR(element_quality(mesh, 0), -1.0, 1e-11);
}

TEST(Quality, MeasuresTheCornerOfACube) {
    const MeshQuality q = measure_quality(corner_tetrahedron());
    EXPECT_DOUBLE_EQ(q.volume, 1.0 / 6.0);
    EXPECT_DOUBLE_EQ(q.min_edge, 1.0);
    EXPECT_DOUBLE_EQ(q.max_edge, std::sqrt(2.0));
    EXPECT_NEAR(q.min_quality, 12.0 * std::cbrt(0.25) / 9.0, 1e-15);
    EXPECT_EQ(q.parts, 1U);
    EXPECT_EQ(q.low, Vec3(0, 0, 0));
    EXPECT_EQ(q.high, Vec3(1, 1, 1));
}

TEST(Quality, CountsPieces) {
    TetMesh mesh = make_box({1, 1, 1}, 2, 2, 2);
    const TetMesh other = mesh;
    const auto shift = static_cast<int>(mesh.node.size());
    for (const Vec3& x : other.node)
        mesh.node.push_back(x + Vec3(2, 0, 0));
    for (const int n : other.element)
        mesh.element.push_back(n + shift);
    EXPECT_EQ(measure_quality(mesh).parts, 2U);
}

TEST(CheckMesh, AcceptsASingleTetrahedronOfEitherOrder) {
    EXPECT_EQ(refusal(corner_tetrahedron()), "accepted");
    EXPECT_EQ(refusal(quadratic_tetrahedron()), "accepted");
}

TEST(CheckMesh, RefusesWithElementValueAndCure) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    TetMesh m = corner_tetrahedron();
    m.element.clear();
    EXPECT_THAT(refusal(m), AllOf(HasSubstr("tet:"), HasSubstr("no tetrahedra: give")));

    m = corner_tetrahedron();
    m.element.push_back(0);
    EXPECT_THAT(refusal(m), HasSubstr("5 node indices, not a multiple of 4"));

    m = corner_tetrahedron();
    m.element[3] = 4;
    EXPECT_THAT(refusal(m), HasSubstr("element 0 uses node 4 of a mesh of 4: give indices from 0"));
    m.element[3] = -1;
    EXPECT_THAT(refusal(m), HasSubstr("element 0 uses node -1"));

    m = corner_tetrahedron();
    m.element[3] = 1;
    EXPECT_THAT(refusal(m), HasSubstr("element 0 uses node 1 twice: give 4 different"));

    m = corner_tetrahedron();
    m.node[2][1] = kNan;
    EXPECT_THAT(refusal(m), HasSubstr("node 2 is at (0, nan, 0): give finite"));

    m = corner_tetrahedron();
    m.node.emplace_back(2, 2, 2);
    EXPECT_THAT(refusal(m), HasSubstr("node 4 belongs to no element"));

    m = corner_tetrahedron();
    std::swap(m.element[0], m.element[1]);
    EXPECT_THAT(refusal(m), HasSubstr("element 0 is inverted (volume -0.167 m^3): swap"));

    m = corner_tetrahedron();
    m.node[3] = {0.3, 0.3, 0.0};
    EXPECT_THAT(refusal(m), HasSubstr("element 0 is flat"));

    m = corner_tetrahedron();
    m.node[3] = {0.3, 0.3, 1e200}; // the squares overflow
    EXPECT_THAT(refusal(m), HasSubstr("element 0 is flat"));

    m = corner_tetrahedron();
    m.group = {1};
    m.group_name = {"head"};
    EXPECT_THAT(refusal(m), HasSubstr("element 0 is in group 1 of 1"));
}

// Flatness is judged by shape, not by size: a needle of a nanometre is a sound element.
TEST(CheckMesh, JudgesFlatnessByShapeAlone) {
    TetMesh m = corner_tetrahedron();
    for (Vec3& x : m.node)
        x *= 1e-9;
    EXPECT_EQ(refusal(m), "accepted");
    m = corner_tetrahedron();
    m.node[3][2] = 1e-6; // quality 12 (0.5e-6)^(2/3) / ... about 1e-4
    EXPECT_EQ(refusal(m), "accepted");
    m.node[3][2] = 1e-15; // a few units in the last place of the other nodes
    EXPECT_THAT(refusal(m), HasSubstr("flat"));
}

TEST(CheckMesh, RefusesDuplicateOverlapAndThirdOnAFace) {
    TetMesh m = corner_tetrahedron();
    m.element = {0, 1, 2, 3, 1, 2, 0, 3};
    EXPECT_THAT(refusal(m), HasSubstr("element 1 overlaps element 0"));

    m = corner_tetrahedron();
    m.node.emplace_back(0.1, 0.1, 2.0);
    m.element = {0, 1, 2, 3, 0, 1, 2, 4};
    EXPECT_THAT(refusal(m), HasSubstr("element 1 overlaps element 0 behind their face 0 1 2"));

    m.node.emplace_back(0.0, 0.0, -1.0);
    m.element = {0, 1, 2, 3, 0, 2, 1, 5, 0, 1, 2, 4};
    EXPECT_THAT(refusal(m), HasSubstr("element 2 is the third on face 0 1 2, after elements 0 and "
                                      "1"));
}

TEST(CheckMesh, RefusesQuadraticNeighboursWithoutCommonMidEdgeNodes) {
    TetMesh m = quadratic_tetrahedron();
    m.node.emplace_back(0, 0, -1); // 10: a second tetrahedron below 0 2 1
    const int second[4] = {0, 2, 1, 10};
    std::vector<int> nodes(std::begin(second), std::end(second));
    for (const auto& [i, j] : kTetEdge) {
        nodes.push_back(static_cast<int>(m.node.size()));
        m.node.push_back(0.5 * (m.node[static_cast<std::size_t>(second[i])] +
                                m.node[static_cast<std::size_t>(second[j])]));
    }
    m.element.insert(m.element.end(), nodes.begin(), nodes.end());
    EXPECT_THAT(refusal(m), HasSubstr("element 1 does not share the mid-edge node of edge 0 2"));
}

TEST(CheckMesh, RefusesAQuadraticElementThatFolds) {
    TetMesh m = quadratic_tetrahedron();
    m.node[4] = {0.5, 0.05, 0.05}; // bends inwards, still one-to-one
    EXPECT_EQ(refusal(m), "accepted");
    m.node[4] = {0.9, 0.0, 0.0}; // beyond three quarters the edge runs back
    EXPECT_THAT(refusal(m), HasSubstr("element 0 folds over itself"));
}

// Midpoint in the middle: det J is constant. Moved by d along the edge, the slope at its ends is
// 1 +- 4 d, so that the least Bernstein coefficient is 1 - 4 d.
TEST(Jacobian, FollowsAMidEdgeNodeAlongItsEdge) {
    TetMesh m = quadratic_tetrahedron();
    EXPECT_NEAR(relative_jacobian(m, 0), 1.0, 1e-15);
    EXPECT_NEAR(element_volume(m, 0), 1.0 / 6.0, 1e-16);
    m.node[4][0] += 0.1;
    EXPECT_NEAR(relative_jacobian(m, 0), 0.6, 1e-14);
}

// Edge 0-1 bowed outwards by d in -z: the two faces at it gain volume, but only the face z = 0
// moves along its normal. Its bump 4 l0 l1 d has the integral 4 d * 2 A / 4! = d / 6 with A = 1/2.
TEST(Jacobian, VolumeOfACurvedElementIsExact) {
    TetMesh m = quadratic_tetrahedron();
    m.node[4][2] -= 0.06;
    EXPECT_NEAR(element_volume(m, 0), 1.0 / 6.0 + 0.06 / 6.0, 1e-16);
}

} // namespace
} // namespace ode::soft
