#pragma once

#include "modal/block_system.h"

namespace ode::soft {

/// Rigid motions that a body's supports leave free: six a part, of which those are kept that move
/// no support. Columns are mass-orthonormal over the nodes that are not clamped and hold only those
/// nodes' rows.
/// @param system  of all nodes
/// @param held    one a node: bits 1, 2, 4 for x, y, z held; 7 means clamped
RowMatrix free_rigid_motions(const BlockSystem& system, const std::vector<char>& held);

} // namespace ode::soft
