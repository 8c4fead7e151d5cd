// A thin bowl, whose two faces nearly cancel and whose hollow resonates: the hardest body for a
// table of modes. Judged by an exact series for a shell of no thickness.
#include "source/node_rule.h"
#include "transfer/transfer_table.h"
#include "unit/transfer/shapes.h"
#include "unit/transfer/spherical_cap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ode::sound::test {
namespace {

constexpr double kRadius = 0.1, kDistance = 3.0; // [m]
constexpr double kKa[] = {0.5, 1.0, 2.0, 3.6, 5.0, 7.0};

/// Rayleigh, Theory of Sound, 235: two waves round the bowl.
double swing(double theta) { return (2.0 + std::cos(theta)) * std::pow(std::tan(theta / 2), 2); }

ModalSurface thin_bowl() {
    ModalSurface s;
    s.mesh = bowl(0.01, 10);
    for (const double ka : kKa) {
        s.frequency.push_back(ka / kRadius * Air{}.speed / (2.0 * std::numbers::pi));
        for (const Vec3& x : s.mesh.node) {
            const Vec3 out = x.normalized();
            const double u =
                swing(std::acos(out.z())) * std::cos(2.0 * std::atan2(out.y(), out.x()));
            for (int k = 0; k < 3; ++k)
                s.shape.push_back(u * out[k]);
        }
    }
    for (Vec3& x : s.mesh.node)
        x *= kRadius;
    return s;
}

/// Power of a table over that of the series, of every mode [dB].
std::vector<double> power_errors(const TransferTable& table) {
    std::vector<double> error;
    for (std::size_t m = 0; m < std::size(kKa); ++m) {
        const SphericalCap cap(kKa[m], 2,
                               [](double theta) { return -Air{}.density * swing(theta); });
        double found = 0.0, exact = 0.0;
        constexpr int kDirections = 40; // all have the same waves round the axis
        for (int i = 0; i < kDirections; ++i) {
            const double theta = (i + 0.5) / kDirections * std::numbers::pi;
            const Vec3 x = kDistance * Vec3(std::sin(theta), 0.0, std::cos(theta));
            found += std::norm(table.gain(static_cast<int>(m), x)) * std::sin(theta);
            exact += std::norm(kRadius * cap.pressure(x / kRadius)) * std::sin(theta);
        }
        error.push_back(10.0 * std::log10(found / exact));
    }
    return error;
}

// Boundary elements: the mark of half a decibel, some 0.2 of which are the shell's thickness.
TEST(ThinBowl, TransferHearsItsHollowResonate) {
    TransferOptions options;
    options.max_triangles = 1400; // as the mesh is
    const std::vector<double> error = power_errors(make_transfer_table(thin_bowl(), options));
    for (std::size_t m = 0; m < error.size(); ++m)
        EXPECT_NEAR(error[m], 0.0, 0.5) << "ka " << kKa[m];
}

// The sum over nodes knows the air that a small body carries, not the air in a hollow: good while
// that is small against the wavelength, ten decibels short where it resonates (near ka 3.6).
TEST(ThinBowl, MonopoleIsTenDecibelsShortWhereTheHollowResonates) {
    const std::vector<double> error =
        power_errors(node_table(thin_bowl(), Leaning::kCarried, Air{}, 96000.0));
    EXPECT_NEAR(error[0], 0.0, 3.0);
    EXPECT_NEAR(error[1], 0.0, 3.0);
    EXPECT_LT(error[3], -9.0);
    for (std::size_t m = 0; m < error.size(); ++m)
        std::printf("monopole, ka %g: %+.1f dB\n", kKa[m], error[m]);
}

} // namespace
} // namespace ode::sound::test
