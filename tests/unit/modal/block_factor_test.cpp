#include "modal/block_factor.h"

#include "mesh/generate.h"
#include "modal/assemble.h"
#include "support/dense.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <numeric>

namespace ode::soft {
namespace {

const Solid kSteel{.young = 200e9, .poisson = 0.29, .density = 7850};

BlockSystem plate(int order) {
    const TetMesh mesh = make_plate(0.3, 0.25, 0.01, 7, 6, 1);
    return assemble(mesh, number_nodes(mesh, order), std::span(&kSteel, 1));
}

TEST(Dissect, OrdersEveryNodeOnceAndSeparatesThePieces) {
    const BlockSystem s = plate(2);
    const Dissection d = dissect(s);
    std::vector<int> sorted = d.order, all(s.node_count());
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(sorted, all);
    ASSERT_GT(d.piece.size(), 10u);
    std::vector<int> piece_of(s.node_count());
    for (std::size_t p = 0; p < d.piece.size(); ++p)
        for (int k = d.piece[p].first; k < d.piece[p].last; ++k)
            piece_of[static_cast<std::size_t>(d.order[static_cast<std::size_t>(k)])] =
                static_cast<int>(p);
    const auto is_ancestor = [&](int p, int of) {
        while (of >= 0 && of != p)
            of = d.piece[static_cast<std::size_t>(of)].parent;
        return of == p;
    };
    for (std::size_t i = 0; i < s.node_count(); ++i)
        for (int p = s.start[i]; p < s.start[i + 1]; ++p) {
            const int a = piece_of[i];
            const int b = piece_of[static_cast<std::size_t>(s.column[static_cast<std::size_t>(p)])];
            EXPECT_TRUE(is_ancestor(a, b) || is_ancestor(b, a)) << a << " touches " << b;
        }
}

TEST(BlockFactor, SolvesWhatItFactorised) {
    for (const int order : {1, 2, 3}) {
        const BlockSystem s = plate(order);
        BlockFactor factor(s);
        constexpr double shift = 1e9; // far above rounding: the residual tells about the code
        ASSERT_TRUE(factor.factorise(s, shift));
        EXPECT_EQ(factor.negative_pivots(), 0);
        RowMatrix b(s.size(), 3);
        for (Eigen::Index i = 0; i < b.size(); ++i)
            b.data()[i] = std::sin(1.0 + static_cast<double>(i));
        RowMatrix x = b, kx, mx;
        factor.solve(x);
        multiply_stiffness(s, x, kx);
        multiply_mass(s, x, mx);
        // Backward error: residual against |K| |x|, a few hundred roundings a row.
        const double scale =
            *std::max_element(s.stiffness.begin(), s.stiffness.end()) * x.norm() + b.norm();
        EXPECT_LT((kx + shift * mx - b).norm(), 1e-13 * scale) << order;
    }
}

TEST(BlockFactor, InverseDiagonalIsWhatSolvesGive) {
    for (const int order : {1, 2}) {
        const BlockSystem s = plate(order);
        BlockFactor factor(s);
        ASSERT_TRUE(factor.factorise(s, 1e9));
        const std::vector<Eigen::Matrix3d> block = factor.inverse_diagonal();
        RowMatrix x = RowMatrix::Identity(s.size(), s.size());
        factor.solve(x);
        double largest = 0, off = 0;
        for (std::size_t i = 0; i < s.node_count(); ++i) {
            const auto r = 3 * static_cast<Eigen::Index>(i);
            const Eigen::Matrix3d solved = x.block<3, 3>(r, r);
            largest = std::max(largest, solved.norm());
            off = std::max(off, (block[i] - solved).norm());
        }
        EXPECT_LT(off, 1e-12 * largest) << order; // both lose what the condition number takes
    }
}

TEST(BlockFactor, CountsEigenvaluesBelowTheShift) {
    const BlockSystem s = plate(1);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
        dense_stiffness(s), dense_mass(s), Eigen::EigenvaluesOnly);
    BlockFactor factor(s);
    for (const Eigen::Index k : {6, 9, 40, 100, 250}) {
        const double sigma = 0.5 * (dense.eigenvalues()[k] + dense.eigenvalues()[k - 1]);
        factor.factorise(s, -sigma, false);
        EXPECT_EQ(factor.negative_pivots(), k);
    }
}

TEST(BlockFactor, StopsWhenTold) {
    const BlockSystem s = plate(2);
    BlockFactor factor(s);
    int calls = 0;
    EXPECT_FALSE(factor.factorise(s, 1.0, true, [&](double) { return ++calls < 3; }));
    EXPECT_EQ(calls, 3);
}

} // namespace
} // namespace ode::soft
