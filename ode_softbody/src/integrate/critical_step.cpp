#include "integrate/critical_step.h"

#include "integrate/largest_frequency.h"
#include "integrate/modal_response.h"

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

double least_viscous_time(const Solid& s) noexcept {
    const double bulk = s.lambda() + 2 * s.mu() / 3;
    const double viscous_bulk = s.viscous_lambda() + 2 * s.viscous_mu() / 3;
    return std::min(viscous_bulk / bulk, s.viscous_mu() / s.mu());
}

double critical_step(const IntegratorKind& method, double frequency, double least, double most) {
    if (method.implicit)
        return std::numeric_limits<double>::infinity();
    // Both move positions by the same recurrence.
    if (method.name == "central-difference" || method.name == "symplectic-euler")
        return critical_step(frequency, most);
    ModalAnalysis analysis(method.name);
    double smallest = analysis.critical_step(frequency, least);
    // What lies between two bounds on the damping is bounded by neither: looked at in steps.
    for (int i = 1; i <= 4 && most > least; ++i)
        smallest =
            std::min(smallest, analysis.critical_step(frequency, least + (most - least) * i / 4));
    return smallest;
}

double critical_step(const ElasticModel& model, std::span<const double> inverse_mass,
                     const NodeArray& position, double beta) {
    return critical_step(largest_frequency(model.stiffness(position), inverse_mass).upper, beta);
}

} // namespace ode::soft
