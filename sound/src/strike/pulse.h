#pragma once

namespace ode::sound {

/// How the force of a blow goes in time: sin^(3/2)(pi u), u from 0 to 1 over the time of contact,
/// which is Hertz's own course to 2 % (S. C. Hunter, J. Mech. Phys. Solids 5, 1957).
/// @return the share of the impulse given by u; 0 before, 1 after.
double pulse_share(double u) noexcept;

} // namespace ode::sound
