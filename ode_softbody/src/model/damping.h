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

/// Damping of a modal body, by one of three laws.
struct Damping {
    enum class Law {
        kRayleigh,   ///< `rayleigh`
        kLossFactor, ///< `loss_factor` at all frequencies: material damping of metals, glass, wood
        kTable,      ///< `t60` mode by mode
    };
    Law law = Law::kRayleigh;
    RayleighDamping rayleigh;
    double loss_factor = 0;  ///< [-]
    std::vector<double> t60; ///< [s]; modes beyond the table take its last entry

    /// Decay rate of each mode [1/s].
    /// @throws InputError for a negative or not finite parameter, an empty table or an entry that
    /// isn't positive (infinite is allowed: undamped).
    std::vector<double> decays(std::span<const double> frequency) const;
};

} // namespace ode::soft
