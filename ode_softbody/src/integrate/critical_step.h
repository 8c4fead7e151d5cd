#pragma once

#include "integrate/integrator.h"
#include "model/elastic_model.h"
#include "model/solid.h"

#include <span>

namespace ode::soft {

/// Largest stable step of CentralDifference [s], viscosity lagged by half a step, for matrices
/// M (lumped), K, C = beta K.
///
/// M (u+ - 2u + u-) + h C (u - u-) + h^2 K u = 0 is, with u - u- = (u+ - u-)/2 - (u+ - 2u + u-)/2,
/// central difference with centred damping on the mass M - h C/2. Centred damping takes nothing
/// from stability, so the condition is 4 (M - h C/2) - h^2 K > 0. With C = beta K it reads
/// h^2 w^2 + 2 h beta w^2 < 4. Mass-proportional damping is integrated exactly (kick()) and never
/// lowers the limit.
/// @param frequency  largest angular frequency, or a bound on it [rad/s]; 0: no limit.
/// @param beta       [s]
double critical_step(double frequency, double beta) noexcept;

/// Least beta for which C <= beta K (in the sense of quadratic forms) holds for a solid: viscosity
/// over stiffness, in pure volume change or in pure shear, whichever is larger [s]. Not
/// max(phi/lambda, psi/mu), which is infinite for nu = 0.
double viscous_time(const Solid& solid) noexcept;

/// The same from below: the largest beta for which beta K <= C.
double least_viscous_time(const Solid& solid) noexcept;

/// Of a named method: closed form where there is one, else found from the method's code
/// (ModalAnalysis). 0: undamped modes grow at any step; infinite: at none. Some methods owe their
/// stability to damping and others suffer from it, so that it is bounded from both sides.
/// @param least, most  beta, with least K <= C <= most K.
double critical_step(const IntegratorKind& method, double frequency, double least, double most);

/// critical_step() of a body as it stands, from the upper end of largest_frequency(). Never above
/// the exact value but for the bracket's probability of 1e-12, and never below 0.95 of it when
/// C = beta K (0.97 when undamped). For steps in use take kSubstepSafety of it and estimate again
/// when StrainExtremes::max_stretch has grown: stretch stiffens. Costs an assembly and about 75
/// products with the stiffness matrix; allocates.
double critical_step(const ElasticModel& model, std::span<const double> inverse_mass,
                     const NodeArray& position, double beta);

// What bodies take of it by default: room for what the bound at rest doesn't see, contact stiffness
// (its share of the largest eigenvalue is limited to 0.15, which shrinks the step by 1/sqrt(1.15) =
// 0.93) and strain.
inline constexpr double kSubstepSafety = 0.9;

} // namespace ode::soft
