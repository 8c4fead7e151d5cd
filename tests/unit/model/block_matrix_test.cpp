#include "model/block_matrix.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace ode::soft {
namespace {

TEST(BlockMatrix, AddsBlocksWhereNodesMeetAndStoresNoOthers) {
    // Two triangles that share nodes 1 and 2; node 4 belongs to nothing.
    BlockMatrix blocks(std::vector<int>{0, 1, 2, 2, 1, 3}, 3, 5);
    const Mat3 a = Mat3::Random(), b = Mat3::Random();
    blocks.add(1, 3, a);
    blocks.add(1, 3, b);
    blocks.add(2, 2, a);
    const Eigen::SparseMatrix<double> m = blocks.take();
    EXPECT_EQ(m.nonZeros(), 9 * (3 + 4 + 4 + 3 + 1));
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(15, 15);
    expected.block<3, 3>(3, 9) = a + b;
    expected.block<3, 3>(6, 6) = a;
    EXPECT_EQ(Eigen::MatrixXd(m), expected);
    EXPECT_TRUE(m.isCompressed());
}

} // namespace
} // namespace ode::soft
