#include "transfer/outgoing.h"

#include "transfer/multipole.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

using Complex = std::complex<double>;

int OutgoingSum::order_for(double kr) {
    return std::clamp(static_cast<int>(std::ceil(1.05 * kr + 2.0 * std::cbrt(kr))) + 6, 6,
                      kMaxOrder);
}

OutgoingSum::OutgoingSum(std::span<const Wave> waves, double radius)
    : wave_(waves.begin(), waves.end()), radius_(radius) {
    double shortest = radius;
    for (const Wave& wave : wave_) {
        highest_ = std::max(highest_, wave.order);
        shortest = std::min(shortest, 1.0 / wave.k);
        sum_.emplace_back(static_cast<std::size_t>(harmonic_count(wave.order)));
    }
    step_ = 1e-4 * shortest; // error of the difference: 1e-8
    for (std::vector<double>& y : harmonic_)
        y.resize(static_cast<std::size_t>(harmonic_count(highest_)));
}

void OutgoingSum::add(const Vec3& place, const Vec3& axis, std::span<const Complex> pressure,
                      std::span<const Complex> slope) {
    const double length = axis.norm();
    const Vec3 along = length > 0.0 ? Vec3(axis / length) : Vec3(Vec3::UnitZ());
    double distance[3];
    for (int j = 0; j < 3; ++j) {
        const Vec3 x = place + (j - 1) * step_ * along;
        distance[j] = x.norm();
        harmonics(distance[j] > 0.0 ? Vec3(x / distance[j]) : Vec3::UnitZ(), highest_,
                  harmonic_[j].data());
    }
    double radial[3][kMaxOrder + 1];
    for (std::size_t w = 0; w < wave_.size(); ++w) {
        const auto [k, order] = wave_[w];
        for (int j = 0; j < 3; ++j)
            spherical_bessel(k * distance[j], order, radial[j]);
        const Complex p = pressure[w] * length / (2.0 * step_);
        for (int l = 0; l <= order; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
                const auto at = static_cast<std::size_t>(i);
                const double rise =
                    radial[2][l] * harmonic_[2][at] - radial[0][l] * harmonic_[0][at];
                const double here = radial[1][l] * harmonic_[1][at];
                sum_[w][at] += Complex(p.real() * rise - slope[w].real() * here,
                                       p.imag() * rise - slope[w].imag() * here);
            }
    }
}

std::vector<Complex> OutgoingSum::on_sphere(std::size_t w) const {
    const auto [k, order] = wave_[w];
    std::vector<Complex> out = sum_[w];
    std::vector<Complex> outgoing(static_cast<std::size_t>(order) + 1);
    spherical_hankel(k * radius_, order, outgoing.data());
    for (int l = 0; l <= order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            out[static_cast<std::size_t>(i)] *=
                Complex(0.0, -k) * outgoing[static_cast<std::size_t>(l)];
    return out;
}

} // namespace ode::sound
