// Modal cases that other finite-element programs publish or were run on (case A13).
#include "mesh/generate.h"
#include "modal/solve_modes.h"
#include "scenes/timoshenko.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace ode::soft {
namespace {

const Solid kSteel{.young = 200e9, .poisson = 0.3, .density = 7850};
const Solid kNafems{.young = 200e9, .poisson = 0.3, .density = 8000};
constexpr double kOnePerCent = 17.2; // cents

ModalOptions cubic(double max_frequency) {
    ModalOptions options;
    options.estimate = false;
    options.max_frequency = max_frequency;
    return options;
}

std::vector<int> nodes_where(const TetMesh& mesh, const std::function<bool(const Vec3&)>& test) {
    std::vector<int> out;
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
        if (test(mesh.node[i]))
            out.push_back(static_cast<int>(i));
    return out;
}

void expect_present(const ModalModel& model, double frequency, double within) {
    double nearest = 1e9;
    for (const double f : model.frequency)
        nearest = std::min(nearest, std::abs(cents(f, frequency)));
    EXPECT_LE(nearest, within) << frequency << " Hz";
}

/// Two elements across: one can't warp as torsion asks.
TetMesh square_bar() { return make_bar(0.3, 0.02, 0.02, 12, 2, 2); }

// 181.20 Hz is Euler and Bernoulli's; the rest a converged three-dimensional reference.
TEST(Conformance, ClampedSteelBar) {
    const TetMesh mesh = square_bar();
    ModalOptions options = cubic(3300);
    options.clamped = nodes_where(mesh, [](const Vec3& x) { return x.x() < 1e-9; });
    const ModalModel model = solve_modes(mesh, std::span(&kSteel, 1), options);
    const double expected[] = {181.27, 181.27, 1113.3, 1113.3, 2401, 3024, 3024};
    ASSERT_EQ(model.mode_count(), 7u);
    for (std::size_t k = 0; k < 7; ++k)
        EXPECT_NEAR(cents(model.frequency[k], expected[k]), 0, kOnePerCent) << k;
}

TEST(Conformance, FreeSteelBar) {
    const TetMesh mesh = square_bar();
    const ModalModel model = solve_modes(mesh, std::span(&kSteel, 1), cubic(3300));
    EXPECT_EQ(model.rigid_modes, 6);
    ASSERT_EQ(model.mode_count(), 4u);
    const double expected[] = {1135.2, 1135.2, 3045, 3045};
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(cents(model.frequency[k], expected[k]), 0, kOnePerCent) << k;
}

// c / (4 L) and c / (2 L), exact without lateral contraction.
TEST(Conformance, BarOfPoissonZeroStretchesAsARod) {
    const TetMesh mesh = square_bar();
    const Solid steel{.young = 200e9, .poisson = 0, .density = 7850};
    ModalOptions options = cubic(9000);
    expect_present(solve_modes(mesh, std::span(&steel, 1), options), 8412.6, 0.1);
    options.max_frequency = 4500;
    options.clamped = nodes_where(mesh, [](const Vec3& x) { return x.x() < 1e-9; });
    expect_present(solve_modes(mesh, std::span(&steel, 1), options), 4206.3, 0.1);
}

// NAFEMS FV32: tapered membrane, 10 m long, 5 to 1 m deep, in plane stress. Half its thickness on
// rollers at the middle plane keeps to the plane; the clamp leaves the thickness free, as plane
// stress does.
TEST(Conformance, TaperedMembraneFv32) {
    TetMesh mesh = make_bar(10, 5, 0.025, 10, 5, 1);
    for (Vec3& x : mesh.node) {
        x.y() *= 1 - 0.08 * x.x();
        x.z() += 0.0125;
    }
    ModalOptions options = cubic(400);
    const auto root = nodes_where(mesh, [](const Vec3& x) { return x.x() < 1e-9; });
    options.rollers = {root, root, nodes_where(mesh, [](const Vec3& x) { return x.z() < 1e-9; })};
    const ModalModel model = solve_modes(mesh, std::span(&kNafems, 1), options);
    const double expected[] = {44.623, 130.03, 162.70, 246.05, 379.90, 391.44};
    ASSERT_GE(model.mode_count(), 6u);
    for (std::size_t k = 0; k < 6; ++k) // peers' converged solids: 44.69 to 392.0, 0.15 % higher
        EXPECT_NEAR(cents(model.frequency[k], expected[k]), 0, 5) << k;
}

// NAFEMS FV16, thin plate, one edge clamped.
TEST(Conformance, CantileveredPlateFv16) {
    const TetMesh mesh = make_plate(10, 10, 0.05, 10, 10, 1);
    ModalOptions options = cubic(7);
    options.clamped = nodes_where(mesh, [](const Vec3& x) { return x.x() < -5 + 1e-9; });
    const ModalModel model = solve_modes(mesh, std::span(&kNafems, 1), options);
    const double expected[] = {0.421, 1.029, 2.582, 3.306, 3.753, 6.555};
    ASSERT_GE(model.mode_count(), 6u);
    for (std::size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(cents(model.frequency[k], expected[k]), 0, kOnePerCent) << k;
}

} // namespace
} // namespace ode::soft
