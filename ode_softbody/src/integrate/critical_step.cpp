#include "integrate/critical_step.h"

#include "integrate/largest_frequency.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {

double critical_step(double frequency, double beta) noexcept {
    if (frequency <= 0)
        return std::numeric_limits<double>::infinity();
    const double square = 4 / (frequency * frequency);
    // sqrt(beta^2 + square) - beta, without cancellation for large beta.
    return square / (std::sqrt(beta * beta + square) + beta);
}

double viscous_time(const Solid& s) noexcept {
    const double bulk = s.lambda() + 2 * s.mu() / 3;
    const double viscous_bulk = s.viscous_lambda() + 2 * s.viscous_mu() / 3;
    return std::max(viscous_bulk / bulk, s.viscous_mu() / s.mu());
}

double critical_step(const ElasticModel& model, std::span<const double> inverse_mass,
                     const NodeArray& position, double beta) {
    return critical_step(largest_frequency(model.stiffness(position), inverse_mass).upper, beta);
}

} // namespace ode::soft
