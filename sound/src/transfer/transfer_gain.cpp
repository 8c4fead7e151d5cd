#include "dsp/kernels.h"
#include "transfer/multipole.h"
#include "transfer/transfer_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

using Complex = std::complex<double>;

/// g_l = h_l(x) e^{ix} of all degrees: no phase to lose. use(l, real, imaginary).
template <class Use>
void reduced(double x, int order, Use&& use) {
    // g_0 = i / x, g_1 = (i / x - 1) / x.
    const double per = 1.0 / x;
    double real = 0.0, imag = per, next_real = -per, next_imag = per * per;
    for (int l = 0; l <= order; ++l) {
        use(l, real, imag);
        const double up = (2.0 * l + 3.0) * per;
        const double after_real = up * next_real - real, after_imag = up * next_imag - imag;
        real = next_real;
        imag = next_imag;
        next_real = after_real;
        next_imag = after_imag;
    }
}

int highest(const TransferTable& table) noexcept {
    int order = 0;
    for (const TransferTable::Mode& mode : table.mode)
        order = std::max(order, mode.order);
    return order;
}

/// The harmonics of a direction, as many as any mode of a table has.
class Directed {
public:
    Directed(const TransferTable& table, const Vec3& place) noexcept : table_(table) {
        const Vec3 way = place - table.centre;
        const double distance = way.norm();
        r_ = std::max(distance, table.radius);
        const int order = highest(table);
        double own[harmonic_count(kMaxOrder)];
        harmonics(distance > 0.0 ? Vec3(way / distance) : Vec3::UnitZ(), order, own);
        for (int i = 0; i < harmonic_count(order); ++i)
            harmonic_[2 * i] = harmonic_[2 * i + 1] = static_cast<float>(own[i]);
    }
    Complex sum(const TransferTable::Mode& mode) const noexcept {
        float part[2 * (kMaxOrder + 1)];
        kernels().by_degree(mode.order,
                            reinterpret_cast<const float*>(table_.coefficient.data() + mode.first),
                            harmonic_, part);
        const Complex* per_sphere = table_.per_sphere.data() + mode.first_degree;
        double real_sum = 0.0, imag_sum = 0.0;
        reduced(kTau * mode.frequency / table_.speed * r_, mode.order,
                [&](int l, double far_real, double far_imag) {
                    const double a = per_sphere[l].real(), b = per_sphere[l].imag();
                    const double x = far_real * a - far_imag * b, y = far_real * b + far_imag * a;
                    const auto real = static_cast<double>(part[2 * l]);
                    const auto imag = static_cast<double>(part[2 * l + 1]);
                    real_sum += x * real - y * imag;
                    imag_sum += x * imag + y * real;
                });
        return {real_sum, imag_sum};
    }

private:
    const TransferTable& table_;
    double r_;
    alignas(64) float harmonic_[2 * harmonic_count(kMaxOrder)];
};

} // namespace

int TransferTable::lobes() const noexcept { return harmonic_count(highest(*this)); }

void TransferTable::add(double frequency, int order,
                        std::span<const std::complex<double>> on_sphere) {
    mode.push_back({frequency, order, coefficient.size(), per_sphere.size()});
    for (const Complex& a : on_sphere)
        coefficient.emplace_back(a);
    const double x = kTau * frequency / speed * radius;
    const Complex phase = std::polar(1.0, x); // of the sphere: its h has e^{-ikR}
    reduced(x, order, [&](int, double real, double imag) {
        per_sphere.push_back(phase / Complex(real, imag));
    });
}

void TransferTable::gains(const Vec3& place, std::span<ModeGain> out) const noexcept {
    const Directed directed(*this, place);
    for (std::size_t m = 0; m < mode.size(); ++m) {
        // p = Re(g q''), and i q'' is -w q' at the mode's frequency.
        const Complex g = directed.sum(mode[m]);
        out[m] = {static_cast<float>(-kTau * mode[m].frequency * g.imag()),
                  static_cast<float>(g.real())};
    }
}

std::complex<double> TransferTable::gain(int m, const Vec3& place) const noexcept {
    return Directed(*this, place).sum(mode[static_cast<std::size_t>(m)]);
}

} // namespace ode::sound
