#pragma once

#include "dsp/decimator.h"
#include "dsp/kernels.h"
#include "source/lean.h"

#include <string_view>

namespace ode::sound {

/// How surface motion becomes pressure; see dSoundSetRadiation().
enum class Radiation { kMonopole, kRayleigh, kPaper, kKirchhoff, kTransfer };

struct Air {
    double density = 1.21; ///< [kg/m^3]
    double speed = 343.0;  ///< of sound [m/s]
};

/// Name by name, in the order of the enumeration; empty past the last.
std::string_view radiation_name(int i) noexcept;

/// @return false for an unknown name.
bool find_radiation(std::string_view name, Radiation& radiation) noexcept;

/// Which faces count, and how.
Facing radiation_facing(Radiation radiation) noexcept;

/// What is louder in front than behind.
Leaning radiation_leaning(Radiation radiation) noexcept;

/// Whether pressure follows the derivative of the retarded sum of flow / distance.
///
/// p = rho / (4 pi) d/dt sum of flow(t - R/c) / R holds exactly for moving sources too, the
/// derivative being the receiver's. It is linear and common to all faces, so that it is taken once
/// an ear, inside the decimator.
bool radiation_differentiates(Radiation radiation) noexcept;

/// What the sum of flow / distance (or its derivative) is multiplied by.
double radiation_gain(Radiation radiation, const Air& air) noexcept;

} // namespace ode::sound
