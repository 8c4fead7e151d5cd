#pragma once

#include "bridge/rigid_model.h"

#include <ode/common.h>

#include <string>

namespace ode::sound {

/// Whether a mesh can be a rigid body's: its box against that of the body's geoms, if it has any.
/// @return empty, or a sentence naming what doesn't fit, by how much, and the cure.
std::string misfit(dBodyID body, const RigidModel& model);

/// What is odd about a pair that fits: masses that differ, no mode to be heard. Empty if nothing.
std::string oddity(dBodyID body, const RigidModel& model);

} // namespace ode::sound
