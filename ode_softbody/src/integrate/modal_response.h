#pragma once

#include "integrate/integrator.h"

namespace ode::soft {

/// What a method makes of one mode of a linear body in a step of h, read off its own code: two
/// steps from two independent states are the columns of its transfer matrix (L, "integrators can be
/// analysed in the modal domain").
struct ModalResponse {
    /// Largest modulus of the matrix's eigenvalues: the factor on the amplitude, a step. Above 1
    /// the method is unstable.
    double amplification;
    /// Damping ratio that the eigenvalue z = exp((-zeta + i sqrt(1 - zeta^2)) w h) stands for, less
    /// the mode's own. Negative where the method feeds the mode.
    double artificial_damping;
    /// Of the period, over the true one: T/T0 - 1. Not a number where either doesn't swing.
    double period_error;
};

/// One method under analysis.
class ModalAnalysis {
public:
    /// @throws InputError for an unknown name
    explicit ModalAnalysis(std::string_view integrator);

    /// @param omega_h        angular frequency of the mode times the step, > 0.
    /// @param damping_ratio  of the mode, >= 0; by a force proportional to velocity.
    ModalResponse response(double omega_h, double damping_ratio);

    /// Largest h [s] below which no mode of angular frequency up to `omega` [rad/s] grows, with the
    /// damping ratio beta w / 2 of stiffness-proportional viscosity: from below, to one part in a
    /// thousand. 0: modes grow at any step; infinite: at none.
    double critical_step(double omega, double beta);

private:
    bool is_stable(double omega, double beta, double h);

    std::unique_ptr<Integrator> method_;
    NodeState state_;
    NodeArray force_;
};

} // namespace ode::soft
