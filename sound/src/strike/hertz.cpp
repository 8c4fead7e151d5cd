#include "strike/hertz.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

double contact_modulus(const Elastic& a, const Elastic& b) noexcept {
    const auto yields = [](const Elastic& side) {
        return (1.0 - side.poisson * side.poisson) / side.young;
    };
    return 1.0 / (yields(a) + yields(b));
}

double contact_time(double mass, double curvature, double modulus, double speed) noexcept {
    const double fifth = mass * mass * curvature / (modulus * modulus * speed);
    // NaN and infinity (a speed of zero, no mass) end at a limit, too.
    const double time = 2.87 * std::pow(fifth, 0.2);
    return time < kLongest ? std::max(time, kShortest) : kLongest;
}

double bearing_stiffness(double load, double curvature, double modulus) noexcept {
    return std::cbrt(6.0 * modulus * modulus * load / curvature);
}

double bearing_radius(double load, double curvature, double modulus) noexcept {
    return std::cbrt(0.75 * load / (modulus * curvature));
}

} // namespace ode::sound
