#include "base/error.h"
#include "mesh/quality.h"
#include "shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace ode::soft {
namespace {

using std::numbers::pi;

class Generated : public testing::TestWithParam<test::Shape> {};
INSTANTIATE_TEST_SUITE_P(, Generated, testing::ValuesIn(test::all_shapes()), test::name_of);

TEST_P(Generated, PassesTheChecksInOnePiece) {
    const TetMesh& mesh = GetParam().mesh;
    EXPECT_NO_THROW(check_mesh(mesh, GetParam().name));
    EXPECT_EQ(measure_quality(mesh).parts, 1U);
}

TEST(Generate, BlocksFillTheirBoxExactly) {
    struct Case {
        TetMesh mesh;
        Vec3 low, high;
    };
    const Case cases[] = {
        {make_box({1.0, 2.0, 3.0}, 3, 4, 5), {-0.5, -1.0, -1.5}, {0.5, 1.0, 1.5}},
        {make_bar(0.3, 0.02, 0.01, 30, 2, 1), {0.0, -0.01, -0.005}, {0.3, 0.01, 0.005}},
        {make_plate(0.4, 0.2, 0.02, 7, 5, 1), {-0.2, -0.1, -0.01}, {0.2, 0.1, 0.01}}};
    for (const Case& c : cases) {
        const MeshQuality q = measure_quality(c.mesh);
        EXPECT_NEAR(q.volume, (c.high - c.low).prod(), 1e-14 * (c.high - c.low).prod() * 100);
        EXPECT_LT((q.low - c.low).norm() + (q.high - c.high).norm(), 1e-15);
    }
}

// The numbers that published measurements on these shapes use.
TEST(Generate, CountsAreAsDocumented) {
    const TetMesh bar = make_bar(0.3, 0.02, 0.01, 30, 2, 1);
    EXPECT_EQ(bar.node.size(), 186U);
    EXPECT_EQ(bar.element_count(), 360U);
    const TetMesh bowl = make_bowl(0.1, 0.005, pi / 2.0, 8, 48, 1);
    EXPECT_EQ(bowl.node.size(), 434U);
    EXPECT_EQ(bowl.element_count(), 1152U);
    const TetMesh sphere = make_sphere(1.0, 4);
    EXPECT_EQ(sphere.node.size(), 309U); // 1 + sum of the shells 10 k^2 + 2
    EXPECT_EQ(sphere.element_count(), 1280U);
}

// A mirrored cut makes a box of even counts its own mirror image: every element has a partner with
// negated x among the elements, up to the order of its nodes.
TEST(Generate, BoxOfEvenCountsIsSymmetric) {
    const TetMesh mesh = make_box({1.0, 1.0, 1.0}, 2, 2, 2);
    for (int axis = 0; axis < 3; ++axis) {
        const auto centres = [&](double sign) {
            std::vector<std::array<double, 3>> out;
            for (std::size_t e = 0; e < mesh.element_count(); ++e) {
                Vec3 sum = Vec3::Zero();
                for (const int n : mesh.nodes_of(e))
                    sum += mesh.node[static_cast<std::size_t>(n)];
                sum[axis] *= sign;
                out.push_back(
                    {std::round(sum[0] * 1e6), std::round(sum[1] * 1e6), std::round(sum[2] * 1e6)});
            }
            for (auto& c : out)
                for (double& x : c)
                    x += 0.0; // -0 to 0
            std::sort(out.begin(), out.end());
            return out;
        };
        EXPECT_EQ(centres(1.0), centres(-1.0)) << axis;
    }
}

struct Curved {
    const char* name;
    std::function<TetMesh(int)> make; // element size proportional to 1 / argument
    double volume;
    double least_quality;
};

// Facets cut off a share of the volume proportional to the square of their size, so that halving it
// quarters the error: second order within 10 % once in the asymptotic range.
TEST(Generate, CurvedVolumesConvergeAtSecondOrder) {
    const Curved cases[] = {
        {"bowl", [](int n) { return make_bowl(0.1, 0.02, pi / 2.0, 4 * n, 24 * n, n); },
         2.0 * pi / 3.0 * (1e-3 - 5.12e-4), 0.3},
        {"cap", [](int n) { return make_bowl(0.1, 0.02, 2.0, 6 * n, 30 * n, n); },
         2.0 * pi / 3.0 * (1.0 - std::cos(2.0)) * (1e-3 - 5.12e-4), 0.3},
        {"tube", [](int n) { return make_tube(1.0, 0.2, 0.1, 8 * n, 12 * n, n); }, pi * 0.03, 0.3},
        {"sphere", [](int n) { return make_sphere(0.5, 3 * n); }, pi / 6.0, 0.6}};
    for (const Curved& c : cases) {
        const MeshQuality coarse = measure_quality(c.make(1));
        const MeshQuality fine = measure_quality(c.make(2));
        const double rate =
            std::log2(std::abs(coarse.volume - c.volume) / std::abs(fine.volume - c.volume));
        EXPECT_NEAR(rate, 2.0, 0.1) << c.name;
        EXPECT_GT(fine.min_quality, c.least_quality) << c.name;
    }
}

TEST(Generate, RefusesWithThingValueAndCure) {
    static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto sentence = [](const std::function<void()>& make) -> std::string {
        try {
            make();
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    using testing::HasSubstr;
    EXPECT_THAT(sentence([] { make_box({1, -1, 1}, 1, 1, 1); }), HasSubstr("along y is -1 m"));
    EXPECT_THAT(sentence([] { make_box({1, 1, kNan}, 1, 1, 1); }), HasSubstr("along z is nan"));
    EXPECT_THAT(sentence([] { make_bar(1, 1, 1, 0, 1, 1); }), HasSubstr("give at least 1"));
    EXPECT_THAT(sentence([] { make_plate(1, 1, 1, 100000, 100000, 100000); }),
                HasSubstr("lower its counts"));
    EXPECT_THAT(sentence([] { make_bowl(0.1, 0.1, 1, 8, 48, 1); }), HasSubstr("thinner"));
    EXPECT_THAT(sentence([] { make_bowl(0.1, 0.01, 4, 8, 48, 1); }), HasSubstr("4 rad"));
    EXPECT_THAT(sentence([] { make_tube(1, 0.1, 0.2, 1, 8, 1); }), HasSubstr("inner"));
    EXPECT_THAT(sentence([] { make_tube(1, 0.2, 0.1, 1, 2, 1); }), HasSubstr("at least 3"));
    EXPECT_THAT(sentence([] { make_sphere(1, 0); }), HasSubstr("the refinement is 0"));
    EXPECT_THAT(sentence([] { make_sphere(1, 2000000000); }), HasSubstr("lower its counts"));
}

} // namespace
} // namespace ode::soft
