#pragma once

#include <cstddef>

namespace ode::soft {

struct KickDriftFactors {
    double keep;  ///< of the old velocity [-]
    double gain;  ///< of the acceleration [s]
    double drift; ///< of the new velocity [s]
};

/// v = keep v + gain f/m, then x += drift v unless `position` is null. Arrays as NodeArray::data().
/// Nodes of inverse mass 0 keep their velocity whole.
using KickDrift = void (*)(std::size_t nodes, const double* inverse_mass,
                           const KickDriftFactors& factors, const double* force, double* velocity,
                           double* position);

} // namespace ode::soft
