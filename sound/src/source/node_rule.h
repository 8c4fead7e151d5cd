#pragma once

#include "source/lean.h"
#include "source/radiation.h"
#include "source/rigid_sound.h"
#include "transfer/transfer_table.h"

namespace ode::sound {

/// How modes sound by the rule that nodes are heard by (Lean), as a table: so that a body sounds
/// alike whether it moves in its modes or node by node, and no node has to be worked out for it.
/// Milliseconds to a second; nothing is solved for but the air that a small body carries.
///
/// At a mode's own frequency the table is the sum over the nodes to the far field's 1/r; nearer
/// than a radius or so the two differ as TransferTable's limit says.
/// @param rate  of the grid that nodes are heard on [Hz].
TransferTable node_table(const ModalSurface& surface, Leaning leaning, const Air& air, double rate);

/// The motion of a body as a whole: what its volume and the air that it carries make of it.
/// @param origin  that it turns about [m].
RigidSound rigid_sound(const BoundaryMesh& mesh, const Vec3& origin, const Air& air);

} // namespace ode::sound
