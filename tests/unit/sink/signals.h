#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace ode::sound::test {

/// White noise in [-1, 1) by a linear congruence (Numerical Recipes): every bit pattern of a
/// float's mantissa occurs, so that equal bits mean that nothing was computed with them.
inline std::vector<float> noise(std::size_t samples, std::uint32_t seed = 1) {
    std::vector<float> x(samples);
    for (float& value : x) {
        seed = 1664525U * seed + 1013904223U;
        value = static_cast<float>(static_cast<std::int32_t>(seed)) / 2147483648.0F;
    }
    return x;
}

/// Stereo: the same sine of `omega` radians a frame on the left, a quarter period later on the
/// right.
inline std::vector<float> sine(std::size_t frames, double omega, double amplitude) {
    std::vector<float> x(2 * frames);
    for (std::size_t i = 0; i < frames; ++i) {
        const double phase = omega * static_cast<double>(i);
        x[2 * i] = static_cast<float>(amplitude * std::sin(phase));
        x[2 * i + 1] = static_cast<float>(amplitude * std::cos(phase));
    }
    return x;
}

/// Largest |x[n] - 2 cos(omega) x[n-1] + x[n-2]| on either channel: 0 for any sine of omega, so
/// that what is left is what was done to it. A step of height s gives s; omega = 0 measures kinks.
inline double click(const std::vector<float>& x, double omega) {
    double largest = 0;
    for (std::size_t i = 4; i < x.size(); ++i)
        largest =
            std::fmax(largest, std::fabs(double{x[i]} - 2 * std::cos(omega) * double{x[i - 2]} +
                                         double{x[i - 4]}));
    return largest;
}

/// Largest step from frame to frame on either channel.
inline double step(const std::vector<float>& x) {
    double largest = 0;
    for (std::size_t i = 2; i < x.size(); ++i)
        largest = std::fmax(largest, std::fabs(double{x[i]} - double{x[i - 2]}));
    return largest;
}

constexpr double kMinus60dB = 1e-3;

inline double omega_of(double frequency, double rate) {
    return 2 * std::numbers::pi * frequency / rate;
}

} // namespace ode::sound::test
