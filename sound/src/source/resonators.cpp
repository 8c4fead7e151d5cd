#include "source/resonators.h"

#include "transfer/wave.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

/// e^-x; between two views little has faded.
double faded(double x) noexcept {
    constexpr double kLittle = 1e-2; // the series errs by 1e-12
    if (std::fabs(x) > kLittle)
        return std::exp(-x);
    return 1.0 - x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0))));
}

} // namespace

Resonators::Resonators(std::span<const double> omega, std::span<const double> decay, double rate)
    : omega_(omega.begin(), omega.end()), decay_(decay.begin(), decay.end()), damped_(omega.size()),
      angle_(omega.size()), cosine_(omega.size()), sine_(omega.size()) {
    for (AlignedVector& row : tick_)
        row.assign(omega.size(), 0.0);
    for (std::size_t k = 0; k < size(); ++k) {
        // What creeps is no sound.
        damped_[k] = std::sqrt(std::max(0.0, (omega_[k] - decay_[k]) * (omega_[k] + decay_[k])));
        double q = 1.0, v = 0.0;
        const auto one = [&](double a, double b) {
            q = a, v = b;
            const double c = std::cos(damped_[k] / rate), fade = std::exp(-decay_[k] / rate);
            const double s = damped_[k] > 0 ? std::sin(damped_[k] / rate) / damped_[k] : 0.0;
            const double x = fade * ((c + decay_[k] * s) * q + s * v);
            v = fade * ((c - decay_[k] * s) * v - omega_[k] * omega_[k] * s * q);
            q = x;
        };
        one(1.0, 0.0);
        tick_[0][k] = q, tick_[2][k] = v;
        one(0.0, 1.0);
        tick_[1][k] = q, tick_[3][k] = v;
    }
}

void Resonators::evolve(double time, std::size_t count, double* amplitude, double* rate) noexcept {
    for (std::size_t k = 0; k < count; ++k)
        angle_[k] = damped_[k] * time;
    turn(angle_.data(), static_cast<int>(count), cosine_.data(), sine_.data());
    for (std::size_t k = 0; k < count; ++k) {
        const double c = cosine_[k], fade = faded(decay_[k] * time);
        const double s = damped_[k] > 0 ? sine_[k] / damped_[k] : 0.0;
        const double q = amplitude[k], v = rate[k];
        amplitude[k] = fade * ((c + decay_[k] * s) * q + s * v);
        rate[k] = fade * ((c - decay_[k] * s) * v - omega_[k] * omega_[k] * s * q);
    }
}

void Resonators::tick(std::size_t count, double* amplitude, double* rate) const noexcept {
    const double *a = tick_[0].data(), *b = tick_[1].data();
    const double *c = tick_[2].data(), *d = tick_[3].data();
    for (std::size_t k = 0; k < count; ++k) {
        const double q = amplitude[k], v = rate[k];
        amplitude[k] = a[k] * q + b[k] * v;
        rate[k] = c[k] * q + d[k] * v;
    }
}

} // namespace ode::sound
