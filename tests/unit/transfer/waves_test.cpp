#include "transfer/multipole.h"
#include "transfer/wave.h"

#include <gtest/gtest.h>

#include <vector>

namespace ode::sound::test {
namespace {

// sum over l, m of j_l(kr) h_l(kR) Y Y' times -ik is e^{-ikD}/(4 pi D): Abramowitz &
// Stegun 10.1.45.
TEST(Waves, AddUpToAPointSource) {
    constexpr int kOrder = 40;
    const double k = 7.0;
    const Eigen::Vector3d inner(0.2, -0.35, 0.1), outer(0.9, 0.7, -0.8);
    std::vector<double> y(harmonic_count(kOrder)), z(y.size()), j(kOrder + 1);
    std::vector<std::complex<double>> h(kOrder + 1);
    harmonics(inner.normalized(), kOrder, y.data());
    harmonics(outer.normalized(), kOrder, z.data());
    spherical_bessel(k * inner.norm(), kOrder, j.data());
    spherical_hankel(k * outer.norm(), kOrder, h.data());
    std::complex<double> sum = 0.0;
    for (int l = 0; l <= kOrder; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            sum += std::complex<double>(0, -k) * j[static_cast<std::size_t>(l)] *
                   h[static_cast<std::size_t>(l)] * y[static_cast<std::size_t>(i)] *
                   z[static_cast<std::size_t>(i)];
    const double d = (outer - inner).norm();
    EXPECT_LT(std::abs(sum - std::polar(1.0 / (4.0 * M_PI * d), -k * d)), 1e-10);
}

TEST(Waves, BesselAgreesWithTheStandardLibraryFarAndNear) {
    std::vector<double> j(61);
    for (const double x : {1e-12, 1e-3, 0.7, 3.14159265358979, 20.0, 63.0}) {
        spherical_bessel(x, 60, j.data());
        for (unsigned l = 0; l <= (x < 0.1 ? 1u : 60u); ++l) // beyond, the library's gives NaN
            EXPECT_NEAR(j[l], std::sph_bessel(l, x), 1e-12) << l << " of " << x;
    }
}

TEST(Waves, TurnIsSineAndCosine) {
    std::vector<double> x, c, s;
    for (int i = 0; i < 4001; ++i)
        x.push_back(i * 0.1);
    c.resize(x.size()), s.resize(x.size());
    turn(x.data(), static_cast<int>(x.size()), c.data(), s.data());
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_NEAR(c[i], std::cos(x[i]), 2e-9);
        EXPECT_NEAR(s[i], std::sin(x[i]), 2e-9);
    }
}

} // namespace
} // namespace ode::sound::test
