#pragma once

namespace ode::sound {

/// How the force of a blow goes in time: sin^(3/2)(pi u), u from 0 to 1 over the time of contact,
/// which is Hertz's own course to 2 % (S. C. Hunter, J. Mech. Phys. Solids 5, 1957).
/// @return the share of the impulse given by u; 0 before, 1 after.
double pulse_share(double u) noexcept;

/// How much of the impulse an oscillator of w feels that is pressed so for a time T, as if all came
/// at mid-time: the spectrum at x = w T, real, 1 at 0, and its derivative by x. Beyond x = 60 less
/// than 1e-4: 0.
struct PulseSpectrum {
    double value = 0.0, slope = 0.0;
};
PulseSpectrum pulse_spectrum(double x) noexcept;

} // namespace ode::sound
