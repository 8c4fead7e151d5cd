#include "transfer/multipole.h"
#include "transfer/transfer_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

using Complex = std::complex<double>;

/// g_l = h_l(x) e^{ix} of all degrees: no phase to lose. use(l, g_l).
template <class Use>
void reduced(double x, int order, Use&& use) {
    const Complex i(0.0, 1.0);
    Complex before = i / x, now = before;
    for (int l = 0; l <= order; ++l) {
        if (l == 1) {
            now = (i / x - 1.0) / x;
        } else if (l > 1) {
            const Complex next = (2.0 * l - 1.0) / x * now - before;
            before = now;
            now = next;
        }
        use(l, now);
    }
}

std::complex<double> sum(const TransferTable& table, const TransferTable::Mode& mode, double r,
                         const double* harmonic) noexcept {
    const double k = kTau * mode.frequency / table.speed;
    const std::complex<float>* a = table.coefficient.data() + mode.first;
    const Complex* per_sphere = table.per_sphere.data() + mode.first_degree;
    double real_sum = 0.0, imag_sum = 0.0;
    reduced(k * r, mode.order, [&](int l, Complex far) {
        double real = 0.0, imag = 0.0;
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
            real += static_cast<double>(a[i].real()) * harmonic[i];
            imag += static_cast<double>(a[i].imag()) * harmonic[i];
        }
        const double x = far.real() * per_sphere[l].real() - far.imag() * per_sphere[l].imag();
        const double y = far.real() * per_sphere[l].imag() + far.imag() * per_sphere[l].real();
        real_sum += x * real - y * imag;
        imag_sum += x * imag + y * real;
    });
    return {real_sum, imag_sum};
}

int highest(const TransferTable& table) noexcept {
    int order = 0;
    for (const TransferTable::Mode& mode : table.mode)
        order = std::max(order, mode.order);
    return order;
}

} // namespace

std::size_t TransferTable::scratch_size() const noexcept {
    return static_cast<std::size_t>(harmonic_count(highest(*this)));
}

void TransferTable::add(double frequency, int order,
                        std::span<const std::complex<double>> on_sphere) {
    mode.push_back({frequency, order, coefficient.size(), per_sphere.size()});
    for (const Complex& a : on_sphere)
        coefficient.emplace_back(a);
    const double x = kTau * frequency / speed * radius;
    const Complex phase = std::polar(1.0, x); // of the sphere: its h has e^{-ikR}
    reduced(x, order, [&](int, Complex near) { per_sphere.push_back(phase / near); });
}

void TransferTable::gains(const Vec3& place, std::span<ModeGain> out,
                          std::span<double> scratch) const noexcept {
    const Vec3 way = place - centre;
    const double distance = way.norm();
    harmonics(distance > 0.0 ? Vec3(way / distance) : Vec3::UnitZ(), highest(*this),
              scratch.data());
    const double r = std::max(distance, radius);
    for (std::size_t m = 0; m < mode.size(); ++m) {
        // p = Re(g q''), and i q'' is -w q' at the mode's frequency.
        const std::complex<double> g = sum(*this, mode[m], r, scratch.data());
        out[m] = {static_cast<float>(-kTau * mode[m].frequency * g.imag()),
                  static_cast<float>(g.real())};
    }
}

std::complex<double> TransferTable::gain(int m, const Vec3& place) const {
    std::vector<double> harmonic(scratch_size());
    const Vec3 way = place - centre;
    const double distance = way.norm();
    harmonics(distance > 0.0 ? Vec3(way / distance) : Vec3::UnitZ(), highest(*this),
              harmonic.data());
    return sum(*this, mode[static_cast<std::size_t>(m)], std::max(distance, radius),
               harmonic.data());
}

} // namespace ode::sound
