#include "transfer/facet_integral.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode::sound::test {
namespace {

/// The same integrals by the midpoints of n^2 equal parts.
FacetPotential by_parts(const Facet& f, const Vec3& x, int n) {
    FacetPotential sum{Vec3::Zero(), Vec3::Zero()};
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) {
            const bool upright = a + b < n;
            const double u = upright ? a + 1.0 / 3 : n - a - 1.0 / 3;
            const double v = upright ? b + 1.0 / 3 : n - b - 1.0 / 3;
            const Vec3 bary(1.0 - (u + v) / n, u / n, v / n);
            const Vec3 way = x - f.at(bary);
            const double r = way.norm();
            sum.single += f.area / (n * n) / r * bary;
            sum.twice += f.area / (n * n) * way.dot(f.normal) / (r * r * r) * bary;
        }
    return sum;
}

TEST(FacetPotential, AgreesWithSummation) {
    const Facet f(Vec3(0.1, 0.2, 0.3), Vec3(1.2, 0.1, 0.4), Vec3(0.3, 0.9, -0.2));
    for (const Vec3& x :
         {Vec3(0.5, 0.4, 0.6), Vec3(0.5, 0.4, -0.5), Vec3(-1.0, 2.0, 0.3), Vec3(0.6, 0.35, 0.35)}) {
        const FacetPotential closed = potential(f, x), summed = by_parts(f, x, 1000);
        EXPECT_LT((closed.single - summed.single).norm(), 1e-5) << x.transpose();
        EXPECT_LT((closed.twice - summed.twice).norm(), 1e-4) << x.transpose();
    }
}

TEST(FacetPotential, JumpsByTwoPiAHatAcrossItsFace) {
    const Facet f(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
    const Vec3 hat(0.5, 0.3, 0.2);
    const FacetPotential above = potential(f, f.at(hat) + 1e-7 * f.normal);
    const FacetPotential on = potential(f, f.at(hat));
    EXPECT_LT((above.twice - 2.0 * M_PI * hat).norm(), 1e-5);
    EXPECT_EQ(on.twice.norm(), 0.0);
    EXPECT_LT((above.single - on.single).norm(), 1e-5);
}

TEST(FacetPotential, IsFiniteOnTheLineOfAnEdge) {
    const Facet f(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
    for (const double x : {-1.0, 2.0}) {
        const FacetPotential v = potential(f, Vec3(x, 0, 0));
        EXPECT_TRUE(v.single.allFinite() && v.twice.allFinite());
        EXPECT_LT((v.single - by_parts(f, Vec3(x, 0, 0), 500).single).norm(), 1e-5);
    }
}

} // namespace
} // namespace ode::sound::test
