#pragma once

namespace ode::sound {

/// Modified Bessel function of the first kind, order 0.
double bessel_i0(double x) noexcept;

/// Kaiser window at u in [-1, 1], 1 in the middle, 0 outside.
double kaiser(double u, double beta) noexcept;

/// Shape that holds ripple and stop band `attenuation` [dB] down; 50 dB and more.
/// J. F. Kaiser, "Nonrecursive digital filter design using the I0-sinh window function", 1974.
double kaiser_beta(double attenuation) noexcept;

/// Filter length [samples] for a transition band of `transition` cycles per sample. Same source.
int kaiser_length(double attenuation, double transition) noexcept;

/// sin(pi x) / (pi x).
double sinc(double x) noexcept;

/// Derivative of sinc() by x.
double sinc_slope(double x) noexcept;

} // namespace ode::sound
