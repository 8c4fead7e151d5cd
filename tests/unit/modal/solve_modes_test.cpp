#include "modal/solve_modes.h"

#include "base/error.h"
#include "mesh/generate.h"
#include "modal/block_lanczos.h"
#include "modal/modal_problem.h"
#include "support/dense.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace ode::soft {
namespace {

/// Quadratic elements, no estimate.
ModalOptions plain() {
    ModalOptions options;
    options.order = 2;
    options.estimate = false;
    return options;
}

const Solid kSteel{.young = 200e9, .poisson = 0.29, .density = 7850};

ModalModel solve(const TetMesh& mesh, const ModalOptions& options) {
    return solve_modes(mesh, std::span(&kSteel, 1), options);
}

std::vector<int> nodes_where(const TetMesh& mesh, const std::function<bool(const Vec3&)>& test) {
    std::vector<int> out;
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
        if (test(mesh.node[i]))
            out.push_back(static_cast<int>(i));
    return out;
}

TetMesh joined(const TetMesh& a, TetMesh b, const Vec3& move) {
    TetMesh out = a;
    for (const Vec3& x : b.node)
        out.node.push_back(x + move);
    for (const int i : b.element)
        out.element.push_back(i + static_cast<int>(a.node.size()));
    return out;
}

// Oracle: every eigenvalue of the dense pair. A cube has triple and double frequencies.
TEST(SolveModes, FindsExactlyTheDenseSpectrumOfACube) {
    const TetMesh cube = make_box({0.1, 0.1, 0.1}, 3, 3, 3);
    for (const MassKind mass : {MassKind::kConsistent, MassKind::kLumped}) {
        ModalOptions options = plain();
        options.max_frequency = 60000;
        options.mass = mass;
        const ModalModel model = solve(cube, options);
        const BlockSystem s = assemble(cube, number_nodes(cube, 2), std::span(&kSteel, 1), mass);
        const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
            dense_stiffness(s), dense_mass(s), Eigen::EigenvaluesOnly);
        std::vector<double> expected;
        for (const double value : dense.eigenvalues().tail(s.size() - 6))
            if (frequency_of(value) <= 60000)
                expected.push_back(frequency_of(value));
        EXPECT_EQ(model.rigid_modes, 6);
        EXPECT_TRUE(model.complete);
        ASSERT_GT(expected.size(), 60u);
        ASSERT_EQ(model.mode_count(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(model.frequency[i], expected[i], 1e-8 * expected[i]) << i;
    }
}

// A square plate's pairs, on a mesh whose diagonals spare its symmetry or not: none may be lost.
TEST(SolveModes, KeepsNearlyEqualPairsInASmallBasisToo) {
    const TetMesh plate = make_plate(0.3, 0.3, 0.006, 8, 8, 1);
    ModalOptions options = plain();
    options.max_frequency = 12000;
    const ModalModel model = solve(plate, options);
    ModalProblem problem(plate, std::span(&kSteel, 1), options);
    BlockFactor factor(problem.system());
    factor.factorise(problem.system(), problem.shift());
    LanczosOptions tight;
    tight.upper = eigenvalue_of(12000);
    tight.basis_bytes = 8 * 130 * static_cast<std::size_t>(problem.system().size());
    const EigenPairs restarted =
        lowest_pairs(problem.system(), factor, problem.shift(), problem.rigid_motions(), tight);
    ASSERT_GT(model.mode_count(), 50u);
    ASSERT_EQ(static_cast<std::size_t>(restarted.value.size()), model.mode_count());
    for (std::size_t i = 0; i < model.mode_count(); ++i)
        EXPECT_NEAR(frequency_of(restarted.value[static_cast<Eigen::Index>(i)]), model.frequency[i],
                    1e-7 * model.frequency[i]);
}

TEST(SolveModes, ShapesAreMassNormalisedAndOrthogonalToRigidMotion) {
    const TetMesh bar = make_bar(0.3, 0.05, 0.01, 10, 2, 1);
    ModalOptions options = plain();
    options.order = 1; // then the shapes on the mesh's nodes are the whole solution
    const ModalModel model = solve(bar, options);
    const BlockSystem s = assemble(bar, number_nodes(bar, 1), std::span(&kSteel, 1));
    const auto modes = static_cast<Eigen::Index>(model.mode_count());
    ASSERT_GT(modes, 3);
    const RowMatrix x = Eigen::Map<const Eigen::MatrixXd>(model.shape.data(), s.size(), modes);
    RowMatrix mx;
    multiply_mass(s, x, mx);
    EXPECT_LT((x.transpose() * mx - Eigen::MatrixXd::Identity(modes, modes)).cwiseAbs().maxCoeff(),
              1e-6); // vectors are converged to 1e-7 over the gaps
    for (Eigen::Index k = 0; k < modes; ++k) {
        Vec3 momentum = Vec3::Zero();
        for (Eigen::Index i = 0; i < s.size(); ++i)
            momentum[i % 3] += mx(i, k);
        EXPECT_LT(momentum.norm(), 1e-9 * std::sqrt(model.body.mass));
        EXPECT_GT(x.col(k).maxCoeff(), -x.col(k).minCoeff() * (1 - 1e-5)) << "sign";
    }
}

TEST(SolveModes, RepeatsItselfToTheBit) {
    const TetMesh bowl = make_bowl(0.1, 0.005, 1.4, 5, 12, 1);
    const ModalModel a = solve(bowl, plain()), b = solve(bowl, plain());
    EXPECT_EQ(a.frequency, b.frequency);
    EXPECT_EQ(a.shape, b.shape);
}

TEST(SolveModes, GivesEachFreePartSixRigidMotions) {
    const TetMesh bar = make_bar(0.3, 0.05, 0.01, 8, 2, 1);
    const ModalModel one = solve(bar, plain());
    const ModalModel two = solve(joined(bar, bar, {0, 1, 0}), plain());
    EXPECT_EQ(two.rigid_modes, 12);
    ASSERT_EQ(two.mode_count(), 2 * one.mode_count());
    for (std::size_t i = 0; i < two.mode_count(); ++i)
        EXPECT_NEAR(two.frequency[i], one.frequency[i / 2], 1e-7 * one.frequency[i / 2]);
}

// Two cubes that share an edge only: the hinge turns without strain.
TEST(SolveModes, CountsAHingeAmongTheRigidModes) {
    TetMesh a = make_box({1, 1, 1}, 1, 1, 1);
    TetMesh b = a;
    const int before = static_cast<int>(a.node.size());
    TetMesh both = joined(a, b, {1, 1, 0});
    for (int& i : both.element)
        for (int j = 0; i >= before && j < before; ++j)
            if ((both.node[static_cast<std::size_t>(i)] - both.node[static_cast<std::size_t>(j)])
                    .norm() < 1e-12)
                i = j;
    ModalOptions options = plain();
    options.max_frequency = 3000;
    const ModalModel model = solve(both, options);
    EXPECT_EQ(model.rigid_modes, 7);
    ASSERT_GT(model.mode_count(), 0u);
    EXPECT_GT(model.frequency[0], 100);
}

TEST(SolveModes, LeavesTheRigidMotionsThatSupportsDoNotStop) {
    const TetMesh bar = make_bar(0.3, 0.05, 0.01, 6, 2, 1);
    ModalOptions options = plain();
    options.clamped = {0}; // one node: three rotations stay
    EXPECT_EQ(solve(bar, options).rigid_modes, 3);
    options.clamped = nodes_where(bar, [](const Vec3& x) { return x.x() < 1e-6; });
    EXPECT_EQ(solve(bar, options).rigid_modes, 0);
    options.clamped.clear();
    options.rollers[2] = nodes_where(bar, [](const Vec3& x) { return x.x() < 1e-6; });
    EXPECT_EQ(solve(bar, options).rigid_modes, 4); // along x, y, about z; and about the line y
}

TEST(SolveModes, GivesTheLowestOnesWhenANumberIsAskedFor) {
    const TetMesh bar = make_bar(0.3, 0.05, 0.01, 8, 2, 1);
    ModalOptions options = plain();
    const ModalModel all = solve(bar, options);
    options.max_modes = 5;
    const ModalModel five = solve(bar, options);
    ASSERT_EQ(five.mode_count(), 5u);
    EXPECT_FALSE(five.complete);
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_NEAR(five.frequency[i], all.frequency[i], 1e-7 * all.frequency[i]);
}

TEST(SolveModes, RefusesInOneSentence) {
    const TetMesh bar = make_bar(0.3, 0.05, 0.01, 6, 2, 1);
    const auto refused = [&](const ModalOptions& options, const char* what) {
        EXPECT_THAT([&] { solve(bar, options); },
                    testing::ThrowsMessage<InputError>(testing::HasSubstr(what)));
    };
    ModalOptions options = plain();
    options.clamp = true;
    refused(options, "the clamp catches no node");
    options.clamped = nodes_where(bar, [](const Vec3&) { return true; });
    refused(options, "nothing is left to vibrate");
    options.clamped = {100000};
    refused(options, "clamped node 100000 is not in the mesh");
    options = plain();
    options.order = 4;
    refused(options, "order 4");
    options = plain();
    options.max_frequency = 0;
    refused(options, "highest frequency asked for is 0 Hz");
    options = plain();
    options.memory = 1000;
    refused(options, "above the limit");
    EXPECT_THAT([&] { solve(TetMesh{}, plain()); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("no tetrahedra")));
}

TEST(SolveModes, CanBeCancelledAtEveryStage) {
    const TetMesh bar = make_bar(0.3, 0.05, 0.01, 6, 2, 1);
    for (const std::string stage : {"assemble", "factorise", "modes", "verify"}) {
        ModalOptions options = plain();
        options.progress = [&](const ModalProgress& p) { return stage != p.stage; };
        EXPECT_THROW(solve(bar, options), Cancelled) << stage;
    }
}

} // namespace
} // namespace ode::soft
