#include "transfer/coarsen.h"
#include "transfer/helmholtz.h"
#include "transfer/transfer_table.h"

#include "unit/transfer/shapes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ode::sound::test {
namespace {

using Complex = std::complex<double>;
const Complex kI(0.0, 1.0);
double decibel(Complex ratio) { return 20.0 * std::log10(std::abs(ratio)); }

/// Unit density, and w = k: pulsating and oscillating, turn by turn.
ModalSurface two_modes_at(const BoundaryMesh& mesh, std::initializer_list<double> wave_numbers) {
    ModalSurface s;
    s.mesh = mesh;
    for (const double k : wave_numbers)
        for (const bool pulsates : {true, false}) {
            s.frequency.push_back(k);
            for (const Vec3& x : mesh.node)
                for (int c = 0; c < 3; ++c)
                    s.shape.push_back(pulsates ? x[c] : c == 2 ? 1.0 : 0.0);
        }
    return s;
}
TransferOptions unit_options() {
    TransferOptions o;
    o.density = 1.0;
    o.speed = 2.0 * std::numbers::pi;
    return o;
}

// The polyhedron takes 0.30 dB; 0.05 dB are left for the solution and the series.
TEST(TransferTable, SphereMeetsClosedFormNearAndFar) {
    const TransferTable table =
        make_transfer_table(two_modes_at(sphere(2), {0.05, 0.5, 2.0, 5.0}), unit_options());
    for (const double r : {1.05, 2.0, 30.0})
        for (int m = 0; m < 8; m += 2) {
            const double k = table.mode[static_cast<std::size_t>(m)].frequency;
            const Vec3 x = r * Vec3(0, 0.6, 0.8);
            const Complex wave = std::polar(1.0, k); // what is left of e^{-ik(r-1)}
            const Complex pulsating = wave / (r * (1.0 + kI * k));
            const Complex oscillating =
                0.8 * wave * (1.0 + kI * k * r) / (r * r * (2.0 + 2.0 * kI * k - k * k));
            for (const Complex& ratio :
                 {table.gain(m, x) / pulsating, table.gain(m + 1, x) / oscillating}) {
                EXPECT_NEAR(decibel(ratio), 0.0, 0.35) << "r " << r << ", k " << k;
                EXPECT_NEAR(std::arg(ratio), 0.0, 0.1) << "r " << r << ", k " << k;
            }
        }
}

// A surface that reaches out unevenly: the series must give what the integral over it gives.
TEST(TransferTable, SeriesIsTheIntegral) {
    const BoundaryMesh mesh = block(Vec3(2.0, 0.3, 0.1), {20, 3, 1});
    ModalSurface s;
    s.mesh = mesh;
    const double k = 3.0;
    s.frequency = {k};
    for (const Vec3& x : mesh.node) // bent
        s.shape.insert(s.shape.end(), {0.0, 0.0, std::cos(4.0 * x[0])});
    TransferOptions o = unit_options();
    o.max_triangles = 600;
    o.per_wavelength = 0.1; // take it as it is
    const TransferTable table = make_transfer_table(s, o);
    ASSERT_EQ(table.triangles, static_cast<int>(mesh.triangle.size()));
    const HelmholtzProblem problem(mesh);
    Eigen::VectorXcd slope(3 * static_cast<Eigen::Index>(mesh.triangle.size()));
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
        for (std::size_t j = 0; j < 3; ++j)
            slope[static_cast<Eigen::Index>(3 * t + j)] =
                -std::cos(4.0 * problem.facets()[t].corner[j][0]) * problem.facets()[t].normal[2];
    const Eigen::VectorXcd p = problem.solve(k, slope).col(0);
    for (const Vec3& x : {Vec3(0.3, 0.4, 1.9), Vec3(2.5, 1.0, 1.0), Vec3(-8.0, 3.0, 6.0)}) {
        const Complex direct = problem.at(x, k, slope, p);
        const Complex series = table.gain(0, x) * std::polar(1.0, -k * (x - table.centre).norm());
        EXPECT_LT(std::abs(series - direct), 0.01 * std::abs(direct)) << x.transpose();
    }
}

TEST(TransferTable, GainsAreThoseOfEachMode) {
    const TransferTable table =
        make_transfer_table(two_modes_at(sphere(1), {0.5, 2.0}), unit_options());
    std::vector<ModeGain> gain(table.mode.size());
    const Vec3 x(1.0, -2.0, 0.5);
    table.gains(x, gain);
    for (std::size_t m = 0; m < gain.size(); ++m) {
        const Complex g = table.gain(static_cast<int>(m), x);
        const double w = 2.0 * std::numbers::pi * table.mode[m].frequency;
        EXPECT_FLOAT_EQ(gain[m].acceleration, static_cast<float>(g.real()));
        EXPECT_FLOAT_EQ(gain[m].velocity, static_cast<float>(-w * g.imag()));
    }
}

TEST(TransferTable, FineSurfacesAreCoarsened) {
    const BoundaryMesh fine = sphere(4);
    const Coarsened coarse = coarsen(fine, 600);
    EXPECT_EQ(coarse.mesh.triangle.size(), 600u);
    EXPECT_TRUE(is_closed(coarse.mesh));
    for (std::size_t i = 0; i < coarse.kept.size(); ++i)
        EXPECT_EQ(coarse.mesh.node[i], fine.node[static_cast<std::size_t>(coarse.kept[i])]);
    double volume = 0.0;
    for (const Facet& f : coarse.mesh.facets())
        volume += f.area * f.normal.dot(f.corner[0]) / 3.0;
    EXPECT_NEAR(volume / (4.0 / 3.0 * std::numbers::pi), 1.0, 0.03);
}

// Fewer triangles bend a shape's balance of air pushed out and drawn in; what is left over would
// radiate as a monopole, far above a small body's quadrupole. Here the balance is nought.
TEST(TransferTable, CoarseSurfacesPushAsMuchAirAsFineOnes) {
    ModalSurface s;
    s.mesh = sphere(3);
    s.frequency = {0.02};
    for (const Vec3& x : s.mesh.node) // a quadrupole, and 1 cm of breath
        for (int c = 0; c < 3; ++c)
            s.shape.push_back((x[0] * x[0] - x[1] * x[1] + 0.01) * x[c]);
    TransferOptions o = unit_options();
    o.max_triangles = 2000;
    const TransferTable fine = make_transfer_table(s, o);
    o.max_triangles = 300;
    const TransferTable coarse = make_transfer_table(s, o);
    ASSERT_LE(coarse.triangles, 300);
    // Along z the quadrupole is silent.
    const Vec3 x(0.0, 0.0, 50.0);
    EXPECT_NEAR(decibel(coarse.gain(0, x) / fine.gain(0, x)), 0.0, 0.3);
}

// Walls are not glued together, however thin.
TEST(TransferTable, ThinPlatesStayTwoWalls) {
    const Coarsened coarse = coarsen(block(Vec3(1.0, 1.0, 0.01), {30, 30, 1}), 200);
    EXPECT_TRUE(is_closed(coarse.mesh));
    EXPECT_LE(coarse.mesh.triangle.size(), 300u);
    double volume = 0.0;
    for (const Facet& f : coarse.mesh.facets())
        volume += f.area * f.normal.dot(f.corner[0]) / 3.0;
    EXPECT_NEAR(volume, 0.01, 1e-4);
}

TEST(TransferTable, RefusesWhatItCannotSolve) {
    ModalSurface s = two_modes_at(sphere(1), {1.0});
    ModalSurface open = s;
    open.mesh.triangle.pop_back();
    EXPECT_THROW(make_transfer_table(open), std::invalid_argument);
    ModalSurface short_of = s;
    short_of.shape.pop_back();
    EXPECT_THROW(make_transfer_table(short_of), std::invalid_argument);
    ModalSurface still = s;
    still.frequency[0] = 0.0;
    EXPECT_THROW(make_transfer_table(still), std::invalid_argument);
    ModalSurface broken = s;
    broken.shape[5] = std::nan("");
    EXPECT_THROW(make_transfer_table(broken), std::invalid_argument);
}

} // namespace
} // namespace ode::sound::test
