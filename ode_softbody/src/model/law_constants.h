#pragma once

namespace ode::soft {

// What the kernels want to know of a solid under each law; plain data, as tet_kernel.h.

/// Kelvin-Voigt viscosity on the rate of Green's strain (P01 3.1), of every law here.
struct Viscosity {
    double phi; ///< counterpart of lambda [Pa s]
    double psi; ///< counterpart of mu [Pa s]
};

struct StvkConstants {
    double half_lambda; ///< lambda/2 [Pa]
    double mu;          ///< [Pa]
    Viscosity viscosity;
};

/// With the correction that makes the law Hooke's for small strain: see StableNeoHookeanLaw.
struct NeoHookeanConstants {
    double lambda; ///< [Pa]
    double mu;     ///< [Pa]
    Viscosity viscosity;
};

struct CorotatedConstants {
    double lambda; ///< [Pa]
    double two_mu; ///< [Pa]
    Viscosity viscosity;
};

} // namespace ode::soft
