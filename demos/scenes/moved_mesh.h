#pragma once

#include "scenes/world.h"

#include <functional>

namespace scenes {

/// A mesh with its nodes elsewhere. @param move  changes x y z of a node [m]
ode::soft::MeshHandle moved(dSoftMeshID mesh, const std::function<void(double* place)>& move);

} // namespace scenes
