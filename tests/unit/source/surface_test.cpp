#include "source/surface.h"

#include <gtest/gtest.h>

#include <array>

namespace ode::sound {
namespace {

// A tetrahedron among other nodes: only 1, 3, 4, 6 are of the surface.
const std::vector<int> kTriangles = {1, 4, 3, 1, 3, 6, 1, 6, 4, 3, 4, 6};

std::vector<double> body() {
    std::vector<double> x(8 * 4, 7.0);
    const auto set = [&](std::size_t i, std::array<double, 3> p) {
        std::copy(p.begin(), p.end(), x.begin() + static_cast<std::ptrdiff_t>(4 * i));
    };
    set(1, {0.0, 0.0, 0.0});
    set(3, {2.0, 0.0, 0.0});
    set(4, {0.0, 3.0, 0.0});
    set(6, {0.0, 0.0, 4.0});
    return x;
}

TEST(Surface, NumbersItsOwnNodes) {
    const Surface s(kTriangles);
    EXPECT_EQ(s.real_nodes(), 4);
    EXPECT_EQ(s.nodes(), 4);
    EXPECT_EQ(std::vector<int>(s.body_node(), s.body_node() + 4), (std::vector<int>{1, 3, 4, 6}));
    EXPECT_EQ(s.triangles(), 4);
}

TEST(Surface, PadsToFoursWithoutArea) {
    const Surface s(std::vector<int>{0, 1, 2});
    EXPECT_EQ(s.real_nodes(), 3);
    ASSERT_EQ(s.nodes(), 4);
    EXPECT_EQ(s.body_node()[3], 2);
    AlignedVector point = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    AlignedVector area(16);
    s.areas(point.data(), area.data());
    EXPECT_EQ(area[4 * 3 + 2], 0.0);
    EXPECT_NEAR(area[2], 0.5 / 3.0, 1e-16); // a third of the triangle, along +z
}

// A closed surface has no area on the whole: rigid translation sweeps nothing.
TEST(Surface, ClosedSurfaceAddsUpToZero) {
    const Surface s(kTriangles);
    AlignedVector point(16), area(16);
    s.collect(body().data(), 4, point.data());
    s.areas(point.data(), area.data());
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(area[k] + area[4 + k] + area[8 + k] + area[12 + k], 0.0, 1e-15);
}

// Sweep of small displacements is the change of volume, to first order (finite differences).
TEST(Surface, SweptVolumeIsTheChangeOfVolume) {
    const Surface s(kTriangles);
    AlignedVector point(16), area(16);
    s.collect(body().data(), 4, point.data());
    s.areas(point.data(), area.data());
    const auto volume = [&](const AlignedVector& p) {
        double sum = 0.0;
        for (int t = 0; t < s.triangles(); ++t) {
            const double* a = p.data() + 4 * s.triangle()[3 * t];
            const double* b = p.data() + 4 * s.triangle()[3 * t + 1];
            const double* c = p.data() + 4 * s.triangle()[3 * t + 2];
            sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                    a[2] * (b[0] * c[1] - b[1] * c[0])) /
                   6.0;
        }
        return sum;
    };
    EXPECT_NEAR(std::abs(volume(point)), 4.0, 1e-14); // 2 * 3 * 4 / 6
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            AlignedVector more = point, less = point;
            more[4 * i + k] += 1e-4; // volume is linear in one coordinate: exact
            less[4 * i + k] -= 1e-4;
            EXPECT_NEAR(area[4 * i + k], (volume(more) - volume(less)) / 2e-4, 1e-10);
        }
}

} // namespace
} // namespace ode::sound
