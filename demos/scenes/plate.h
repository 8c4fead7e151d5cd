#pragma once

#include "scenes/world.h"

namespace scenes {

/// A square plate, 300 x 300 x 3 mm about the origin, of `cells` a side. Those at its border are
/// half as wide as the mean: held there it bends sharpest.
ode::soft::MeshHandle graded_plate(int cells);
constexpr double kPlateSide = 0.3, kPlateThickness = 3e-3; // [m]

} // namespace scenes
