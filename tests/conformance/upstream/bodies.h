#pragma once

#include "fingerprint.h"

#include <cstdio>

namespace ode::conformance {

/// Adds pose and velocity, bit by bit, of all bodies that the demo has made and not destroyed.
void add_bodies(Fingerprint& state) noexcept;

/// Mechanical energy of these bodies [J]: kinetic, and potential in their worlds' gravity.
/// Kinematic ones have none. Not a number if any of them is nowhere.
double energy_of_bodies() noexcept;

/// One line a body: "body x y z".
void write_bodies(std::FILE* out) noexcept;

} // namespace ode::conformance
