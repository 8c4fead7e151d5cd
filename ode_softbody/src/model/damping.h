#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace ode::soft {

/// How fast a vibration dies away is said in four ways. All follow from the decay rate d [1/s] of
/// the amplitude, exp(-d t), and, where marked, the frequency f [Hz]. For damping ratios below a
/// tenth; above, d and f are no longer independent.

/// Time to fall by 60 dB: ln(1000) / d = 6.908 / d [s]. Infinite without damping.
inline double t60_of_decay(double d) { return std::log(1000.0) / d; }
inline double decay_of_t60(double t60) { return std::log(1000.0) / t60; }

/// Quality factor Q = pi f / d.
inline double quality_of_decay(double d, double f) { return std::numbers::pi * f / d; }
inline double decay_of_quality(double q, double f) { return std::numbers::pi * f / q; }

/// Loss factor eta = 1 / Q = d / (pi f), twice the damping ratio.
inline double loss_factor_of_decay(double d, double f) { return d / (std::numbers::pi * f); }
inline double decay_of_loss_factor(double eta, double f) { return std::numbers::pi * f * eta; }

/// Damping force (alpha M + beta K) v: d = (alpha + beta w^2) / 2, w = 2 pi f.
struct RayleighDamping {
    double alpha = 0; ///< [1/s]
    double beta = 0;  ///< [s]

    double decay(double f) const noexcept {
        const double w = 2 * std::numbers::pi * f;
        return 0.5 * (alpha + beta * w * w);
    }
};

/// The Rayleigh damping with given T60 [s] at two frequencies [Hz].
/// @throws InputError when the frequencies are equal, a number isn't positive, or no alpha, beta >=
/// 0 give it: d may grow with frequency at most by its square, and must not fall.
RayleighDamping rayleigh_through(double f1, double t60_1, double f2, double t60_2);

/// Decay times as measured, in place of what the material says. Between two entries the decay rate
/// is a power of the frequency, so that two describe a loss factor exactly; beyond the first and
/// the last it stays theirs.
class DampingTable {
public:
    DampingTable() = default;
    /// @param frequency  ascending [Hz]
    /// @param t60        of each [s]
    /// @throws InputError naming the entry that isn't positive and finite, or out of order
    DampingTable(std::span<const double> frequency, std::span<const double> t60);

    bool empty() const noexcept { return frequency_.empty(); }
    double decay(double f) const noexcept; ///< [1/s]; of a table that isn't empty

private:
    std::vector<double> frequency_, decay_;
};

} // namespace ode::soft
