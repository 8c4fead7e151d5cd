#pragma once

#include "base/types.h"

#include <span>

namespace ode::soft {

/// Motion of a body's nodes, world frame. When the velocity holds is the integrator's affair: see
/// Integrator::begin().
struct NodeState {
    NodeArray position; ///< [m]
    NodeArray velocity; ///< [m/s]
};

/// What resists acceleration besides the material.
struct NodeInertia {
    std::span<const double> inverse_mass; ///< [1/kg]; 0: the node keeps its velocity, whatever acts
    double alpha = 0;                     ///< mass-proportional damping [1/s]; not on such nodes
};

} // namespace ode::soft
