#pragma once

#include "transfer/boundary.h"

namespace ode::sound {

/// How a body pushes air round itself while it is small against the wavelength.
///
/// A surface element of flow dq radiates as a source that lies `shift` further out than the
/// surface: the sum of sources misses the air that is set in motion beside the body (a sphere of
/// radius a shakes 3/2 of its own volume: shift a n / 2; a thin disc moves no volume at all, and is
/// heard by its shifts alone). By reciprocity shift_i = -phi_i, phi_i the potential of the body
/// moving with unit velocity along axis i: exact for the dipole moment of any motion of the
/// surface.
struct CarriedAir {
    std::vector<Vec3> shift; ///< of every node [m]; empty when there is none to be had
    double pulse_length =
        0.0; ///< pressure of even pulsation at low frequency: rho length dv/dt [m]
    double shake_length = 0.0; ///< root mean square of `shift` [m]
};

/// Incompressible flow round the surface, coarsened to `triangles`: 0.1 s for 300, once a body.
/// Empty for surfaces that are not closed, and for those without extent.
CarriedAir carried_air(const BoundaryMesh& mesh, std::size_t triangles = 300);

} // namespace ode::sound
