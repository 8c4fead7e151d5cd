#include "modal/lagrange.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace ode::soft {
namespace {

class Lagrange : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Orders, Lagrange, testing::Values(1, 2, 3, 4));

TEST_P(Lagrange, IsOneAtItsOwnNodeAndZeroAtTheOthers) {
    const auto points = lagrange_points(GetParam());
    ASSERT_EQ(points.size(), static_cast<std::size_t>(lagrange_nodes(GetParam())));
    std::array<double, kMaxLagrangeNodes> value{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        lagrange_value(GetParam(), points[i], value);
        for (std::size_t j = 0; j < points.size(); ++j)
            EXPECT_NEAR(value[j], i == j ? 1 : 0, 1e-14) << i << " " << j;
    }
}

TEST_P(Lagrange, GradientIsTheSlopeOfTheValue) {
    const Barycentric at(0.13, 0.31, 0.37, 0.19);
    Eigen::Matrix3Xd gradient;
    lagrange_gradient(GetParam(), at, gradient);
    constexpr double h = 1e-6; // central difference of a quartic: error h^2, about 1e-11
    for (int axis = 0; axis < 3; ++axis) {
        std::array<double, kMaxLagrangeNodes> high{}, low{};
        Barycentric step = Barycentric::Unit(axis + 1) - Barycentric::Unit(0);
        lagrange_value(GetParam(), at + h * step, high);
        lagrange_value(GetParam(), at - h * step, low);
        for (Eigen::Index i = 0; i < gradient.cols(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            EXPECT_NEAR(gradient(axis, i), (high[k] - low[k]) / (2 * h), 1e-9);
        }
    }
}

// int x^a y^b z^c over the unit tetrahedron = a! b! c! / (a + b + c + 3)!
TEST(Quadrature, IntegratesPolynomialsUpToItsDegree) {
    for (const int degree : {1, 2, 3, 4, 5, 6, 7, 9})
        for (int a = 0; a <= degree; ++a)
            for (int b = 0; a + b <= degree; ++b)
                for (int c = 0; a + b + c <= degree; ++c) {
                    double sum = 0;
                    for (const auto& [at, weight] : tetrahedron_quadrature(degree))
                        sum +=
                            weight * std::pow(at[1], a) * std::pow(at[2], b) * std::pow(at[3], c);
                    const double exact = std::tgamma(a + 1) * std::tgamma(b + 1) *
                                         std::tgamma(c + 1) / std::tgamma(a + b + c + 4);
                    EXPECT_NEAR(sum, exact, 1e-14) << degree << ": " << a << b << c;
                }
}

} // namespace
} // namespace ode::soft
