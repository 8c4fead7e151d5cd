#pragma once

namespace ode::soft {

/// Isotropic solid with Kelvin-Voigt and mass-proportional damping and a loss factor, which add up.
struct Solid {
    double young = 0;   ///< E [Pa]
    double poisson = 0; ///< nu [-]
    double density = 0; ///< at rest [kg/m^3]
    double phi = 0;     ///< viscous counterpart of lambda [Pa s] (P01 3.1)
    double psi = 0;     ///< viscous counterpart of mu [Pa s] (P01 3.1)
    double alpha = 0;   ///< mass-proportional damping [1/s]
    double beta =
        0; ///< stiffness-proportional damping [s]; adds beta*lambda to phi, beta*mu to psi
    double loss_factor = 0; ///< eta at all frequencies [-]: only modes can have it, no stress

    /// First Lame parameter [Pa].
    double lambda() const noexcept { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
    /// Shear modulus [Pa].
    double mu() const noexcept { return young / (2 * (1 + poisson)); }
    double viscous_lambda() const noexcept { return phi + beta * lambda(); } ///< [Pa s]
    double viscous_mu() const noexcept { return psi + beta * mu(); }         ///< [Pa s]
    bool is_viscous() const noexcept { return viscous_lambda() != 0 || viscous_mu() != 0; }
};

} // namespace ode::soft
