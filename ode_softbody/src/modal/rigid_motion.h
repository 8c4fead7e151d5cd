#pragma once

#include "modal/block_system.h"

namespace ode::soft {

/// Rigid motions that a body's supports leave free: six a part, of which those are kept that move no
/// clamped node. Columns are mass-orthonormal over the nodes that are not clamped and hold only
/// those nodes' rows.
/// @param system  of all nodes
/// @param free    one flag a node: 0 means clamped
RowMatrix free_rigid_motions(const BlockSystem& system, const std::vector<char>& free);

} // namespace ode::soft
