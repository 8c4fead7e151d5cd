#pragma once

namespace ode::sound {

/// How the force of a blow goes in time: sin^(3/2)(pi u), u from 0 to 1 over the time of contact,
/// which is Hertz's own course to 2 % (S. C. Hunter, J. Mech. Phys. Solids 5, 1957).
/// @return the share of the impulse given by u; 0 before, 1 after.
double pulse_share(double u) noexcept;
/// The same at u, u + step, ...
void pulse_shares(double u, double step, int count, double* out) noexcept;

/// How much of the impulse an oscillator of w feels that is pressed so for a time T: the spectrum
/// at x = w T, 1 at 0. Beyond x = 60 less than 1e-4: 0.
double pulse_spectrum(double x) noexcept;

} // namespace ode::sound
