#include "integrate/critical_step.h"

#include "integrate/central_difference.h"
#include "integrate/largest_frequency.h"
#include "model/stvk_linear.h"
#include "unit/model/specimens.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <numbers>

namespace ode::soft {
namespace {

/// A thin open shell of revolution, one layer of cells bent from a box: like a bowl.
TetMesh bent_shell() {
    TetMesh mesh = box_mesh({1, 1, 1}, 7, 5, 1);
    for (Vec3& x : mesh.node) {
        const double along = 0.3 + 1.2 * x.x(), around = 3.0 * x.y(), r = 0.1 + 0.006 * x.z();
        x = r * Vec3(std::sin(along) * std::cos(around), std::sin(along) * std::sin(around),
                     -std::cos(along));
    }
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        int* n = mesh.element.data() + 4 * e;
        const auto at = [&](int i) -> const Vec3& {
            return mesh.node[static_cast<std::size_t>(n[i])];
        };
        if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0)
            std::swap(n[1], n[2]);
    }
    return mesh;
}

/// One node moved until its elements are slivers.
TetMesh with_slivers() {
    TetMesh mesh = box_mesh({0.2, 0.2, 0.2}, 3, 3, 3);
    mesh.node[21] += 0.97 * (mesh.node[22] - mesh.node[21]);
    return mesh;
}

struct Case {
    const char* name;
    TetMesh (*mesh)();
};

class CriticalStep : public testing::TestWithParam<Case> {
protected:
    CriticalStep() {
        for (const double m : model_.mass())
            inverse_mass_.push_back(1 / m);
    }

    double exact_frequency(const NodeArray& x) const {
        const Eigen::MatrixXd k = model_.stiffness(x);
        Eigen::VectorXd scale(k.rows());
        for (Eigen::Index i = 0; i < k.rows(); ++i)
            scale[i] = std::sqrt(inverse_mass_[static_cast<std::size_t>(i / 3)]);
        return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                             scale.asDiagonal() * k * scale.asDiagonal(), Eigen::EigenvaluesOnly)
                             .eigenvalues()
                             .maxCoeff());
    }

    const TetMesh mesh_ = GetParam().mesh();
    const StvkLinear model_{mesh_, rubber()};
    const NodeArray rest_ = node_array(mesh_.node);
    std::vector<double> inverse_mass_;
};

TEST_P(CriticalStep, LiesBetween95And100PercentOfTheExactOne) {
    for (const double beta : {0.0, 1e-4}) {
        const double exact = critical_step(exact_frequency(rest_), beta);
        const double step = critical_step(model_, inverse_mass_, rest_, beta);
        EXPECT_LE(step, exact);
        // The bracket gives away 5 % of the squared frequency: 2.5 % of an undamped step, 5 % of
        // 2 / (beta w^2) when viscosity rules.
        EXPECT_GE(step, (beta == 0 ? 0.97 : 0.95) * exact);
        // The elements' bound is safe too, at any quality.
        EXPECT_LE(critical_step(model_.max_frequency_bound(), beta), exact);
    }
}

TEST_P(CriticalStep, FollowsStretchAndHeldNodes) {
    NodeArray pulled = rest_;
    for (std::size_t i = 0; i < pulled.size(); ++i)
        pulled[i][0] *= 1.54;
    for (std::size_t i = 0; i < pulled.size(); i += 3)
        inverse_mass_[i] = 0;
    const double exact = critical_step(exact_frequency(pulled), 0);
    const double step = critical_step(model_, inverse_mass_, pulled, 0);
    EXPECT_LE(step, exact);
    EXPECT_GE(step, 0.97 * exact);
}

TEST_P(CriticalStep, SeparatesRingingFromBlowingUp) {
    Solid solid = rubber();
    solid.phi = 20;
    solid.psi = 5;
    const StvkLinear viscous(mesh_, solid);
    const double beta = viscous_time(solid);
    const double step = critical_step(model_, inverse_mass_, rest_, beta);
    // C <= beta K, not equal: stable at the step; far above the limit it cannot be.
    for (const double share : {0.999, 2.0}) {
        NodeState state{disturbed(rest_, 1e-9, 4), NodeArray(rest_.size())};
        NodeArray force(rest_.size());
        const NodeInertia inertia{inverse_mass_, 0};
        CentralDifference method;
        double worst = 0;
        for (int n = 0; n < 1000; ++n) {
            force.set_zero();
            method.evaluate(viscous, state, force);
            method.step(viscous, inertia, share * step, state, force);
            worst = std::max(worst, peak(state.velocity) * step);
            if (!(worst < 1e-5))
                break;
        }
        if (share < 1)
            EXPECT_LT(worst, 1e-8);
        else
            EXPECT_GT(worst, 1e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, CriticalStep,
    testing::Values(Case{"bar",
                         [] {
                             return box_mesh({0.3, 0.02, 0.01}, 20, 2, 1);
                         }},
                    Case{"block",
                         [] {
                             return irregular_box({0.2, 0.2, 0.2}, 3, 3, 3);
                         }},
                    Case{"shell", bent_shell}, Case{"slivers", with_slivers},
                    Case{"one_element",
                         [] {
                             TetMesh mesh;
                             mesh.node = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
                             mesh.element = {0, 1, 2, 3};
                             return mesh;
                         }}),
    [](const auto& instance) { return std::string(instance.param.name); });

// C <= beta K for every strain rate, touching for the worst: checked over all ratios of the two.
TEST(ViscousTime, IsTheLeastSafeBeta) {
    for (const double nu : {-0.3, 0.0, 0.3, 0.49})
        for (const double phi : {0.0, 7.0})
            for (const double psi : {0.0, 2.0, 30.0}) {
                Solid s = rubber();
                s.poisson = nu;
                s.phi = phi;
                s.psi = psi;
                double largest = 0;
                for (int i = 0; i <= 1000; ++i) {
                    const double t = std::numbers::pi / 2 * i / 1000;
                    const double volume = std::sin(t), shear = std::cos(t); // tr^2, |dev|^2
                    const double c = (s.phi + 2 * s.psi / 3) * volume + 2 * s.psi * shear;
                    const double k = (s.lambda() + 2 * s.mu() / 3) * volume + 2 * s.mu() * shear;
                    largest = std::max(largest, c / k);
                }
                EXPECT_NEAR(viscous_time(s), largest, 1e-12 * largest);
            }
}

// Frequencies go with the root of the stiffness, whatever the numbers' size, also on meshes so
// small and even that the search ends early.
TEST(LargestFrequency, ScalesWithTheStiffness) {
    for (const int cells : {1, 2, 3}) {
        const TetMesh mesh = box_mesh({0.1, 0.1, 0.1}, cells, cells, cells);
        double first = 0;
        for (const double young : {1e2, 1e6, 3e6, 1e7, 3e7, 1e8, 2e11}) {
            Solid solid = rubber();
            solid.young = young;
            const StvkLinear model(mesh, solid);
            std::vector<double> inverse_mass;
            for (const double m : model.mass())
                inverse_mass.push_back(1 / m);
            const double scaled =
                largest_frequency(model.stiffness(node_array(mesh.node)), inverse_mass).lower /
                std::sqrt(young);
            first = first == 0 ? scaled : first;
            EXPECT_NEAR(scaled, first, 1e-6 * first) << cells << " cells, E " << young;
        }
    }
}

TEST(LargestFrequency, OfNothingFreeIsZeroAndLimitsNothing) {
    const TetMesh mesh = box_mesh({1, 1, 1}, 1, 1, 1);
    const StvkLinear model(mesh, rubber());
    const std::vector<double> held(mesh.node.size(), 0.0);
    const NodeArray rest = node_array(mesh.node);
    EXPECT_EQ(largest_frequency(model.stiffness(rest), held).upper, 0);
    EXPECT_EQ(critical_step(model, held, rest, 0), std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace ode::soft
