#pragma once

#include "modal/block_system.h"

namespace ode::soft {

/// Products of a tall basis (columns contiguous) with a narrow block (rows contiguous), the bulk of
/// Lanczos' work. Eigen's product packs the basis anew for every eight columns of the block and
/// runs at half this speed.

/// c = V^T y over the first `columns` columns of V.
Eigen::MatrixXd transpose_times(const Eigen::MatrixXd& v, Eigen::Index columns, const RowMatrix& y);

/// w -= V c.
void subtract_times(const Eigen::MatrixXd& v, const Eigen::MatrixXd& c, RowMatrix& w);

} // namespace ode::soft
