#pragma once

#include "model/elastic_model.h"

#include <span>

namespace ode::soft {

struct EquilibriumOptions {
    int load_steps = 1;       ///< shares in which the load is put on: more for slender bodies
    int max_iterations = 100; ///< Newton's, in each share
    double tolerance = 1e-9;  ///< largest force left on a node, against the largest load or
                              ///< reaction; as far as rounding lets
};

struct Equilibrium {
    bool converged = false;
    int iterations = 0;  ///< of all shares: an assembly and a factorisation each
    double residual = 0; ///< as `tolerance`
};

/// Where an elastic body comes to rest under forces that keep size and direction (dead load):
/// Newton's method on the energy U(x) - load . x, with a line search that lets it only fall, so
/// that what is found is stable. Where the tangent is not positive definite (at a bifurcation,
/// under compression) it is shifted until it is.
///
/// Allocates; costs a sparse factorisation an iteration. For tests against statics, bodies that are
/// to start at rest, and as the kernel of an implicit step.
/// @param free      one a node; 0: held where it is. Some must be held, or the body flies off.
/// @param load      on each node [N]; on held ones it doesn't matter.
/// @param position  in: where to start, such as at rest; out: where the last share came to [m].
Equilibrium find_equilibrium(const ElasticModel& model, std::span<const char> free,
                             const NodeArray& load, NodeArray& position,
                             const EquilibriumOptions& options = {});

} // namespace ode::soft
