#pragma once

#include "modal/block_system.h"

namespace ode::soft {

inline Eigen::MatrixXd dense_stiffness(const BlockSystem& s) {
    RowMatrix k, unit = RowMatrix::Identity(s.size(), s.size());
    multiply_stiffness(s, unit, k);
    return k;
}

inline Eigen::MatrixXd dense_mass(const BlockSystem& s) {
    RowMatrix m, unit = RowMatrix::Identity(s.size(), s.size());
    multiply_mass(s, unit, m);
    return m;
}

} // namespace ode::soft
