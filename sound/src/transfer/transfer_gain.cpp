#include "transfer/multipole.h"
#include "transfer/transfer_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

/// h_l(kr) / h_l(kR) e^{ikr}, degree by degree, handed to `use(l, ratio)`.
template <class Use>
void outgoing(double kr, double at_radius, int order, Use&& use) {
    // Reduced functions g_l = h_l e^{ix} obey the same recurrence and have no phase to lose.
    using Complex = std::complex<double>;
    const Complex i(0.0, 1.0);
    Complex far = i / kr, far_before = far, near = i / at_radius, near_before = near;
    const Complex phase = std::polar(1.0, at_radius); // of the sphere: its h has e^{-ikR}
    for (int l = 0; l <= order; ++l) {
        if (l == 1) {
            far = (i / kr - 1.0) / kr;
            near = (i / at_radius - 1.0) / at_radius;
        } else if (l > 1) {
            const Complex far_next = (2.0 * l - 1.0) / kr * far - far_before;
            const Complex near_next = (2.0 * l - 1.0) / at_radius * near - near_before;
            far_before = far;
            near_before = near;
            far = far_next;
            near = near_next;
        }
        use(l, far / near * phase);
    }
}

std::complex<double> sum(const TransferTable& table, const TransferTable::Mode& mode, double r,
                         const double* harmonic) noexcept {
    const double k = kTau * mode.frequency / table.speed;
    const std::complex<float>* a = table.coefficient.data() + mode.first;
    std::complex<double> total = 0.0;
    outgoing(k * r, k * table.radius, mode.order, [&](int l, std::complex<double> ratio) {
        double real = 0.0, imag = 0.0;
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
            real += static_cast<double>(a[i].real()) * harmonic[i];
            imag += static_cast<double>(a[i].imag()) * harmonic[i];
        }
        total += ratio * std::complex<double>(real, imag);
    });
    return total;
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
