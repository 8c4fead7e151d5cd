#pragma once

#include "modal/block_system.h"

namespace ode::soft {

using RowMatrixF = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A stiffness in single precision, for what only preconditions: half the memory to pass through,
/// twice the lanes. The pattern is borrowed.
class SingleStiffness {
public:
    explicit SingleStiffness(const BlockSystem& system);

    /// y = K x.
    void multiply(const RowMatrixF& x, RowMatrixF& y) const;

private:
    const BlockSystem& pattern_;
    std::vector<float> stiffness_; ///< nine a pair, row by row
};

} // namespace ode::soft
