#pragma once

#include "mesh/tet_mesh.h"
#include "model/solid.h"

#include <ode_softbody/softbody.h>

#include <vector>

namespace ode::soft {

/// @throws InputError when struct_size is unset.
Solid from_c(const dSoftSolid& given);

/// One a group of the mesh, or one for all of it. @throws InputError
std::vector<Solid> from_c(const dSoftSolid* given, int count, const TetMesh& mesh);

} // namespace ode::soft
