#include "strike/pulse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace ode::sound {
namespace {

constexpr std::size_t kCells = 256;

/// The integral at the ends of cells, and the force there: enough for a cubic in each.
struct Table {
    std::array<double, kCells + 1> share{}, force{};

    Table() {
        constexpr int kFine = 64; // midpoints a cell: exact to 1e-9
        const auto course = [](double u) { return std::pow(std::sin(std::numbers::pi * u), 1.5); };
        for (std::size_t c = 0; c < kCells; ++c) {
            double sum = 0.0;
            for (int i = 0; i < kFine; ++i)
                sum += course((static_cast<double>(c) + (i + 0.5) / kFine) / kCells);
            share[c + 1] = share[c] + sum / (kFine * static_cast<double>(kCells));
        }
        const double all = share[kCells];
        for (std::size_t c = 0; c <= kCells; ++c) {
            share[c] /= all;
            force[c] = course(std::fmin(1.0, static_cast<double>(c) / kCells)) / all;
        }
        force[kCells] = 0.0; // sin(pi) is not quite
    }
};

const Table& table() {
    static const Table made;
    return made;
}

double share_of(const Table& table, double u) noexcept {
    if (!(u > 0.0))
        return 0.0;
    if (u >= 1.0)
        return 1.0;
    const double place = u * kCells;
    const auto c = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(c), h = 1.0 / kCells;
    const double a = table.share[c], b = table.share[c + 1];
    const double da = h * table.force[c], db = h * table.force[c + 1];
    return a + t * (da + t * (3.0 * (b - a) - 2.0 * da - db + t * (2.0 * (a - b) + da + db)));
}

} // namespace

double pulse_share(double u) noexcept { return share_of(table(), u); }

void pulse_shares(double u, double step, int count, double* out) noexcept {
    const Table& course = table();
    // Most of a run lies before or after.
    const auto at = [&](double end) {
        return static_cast<int>(std::clamp(std::ceil((end - u) / step), 0.0, double(count)));
    };
    const int first = at(0.0), last = std::max(first, at(1.0));
    std::fill(out, out + first, 0.0);
    for (int i = first; i < last; ++i)
        out[i] = share_of(course, u + i * step);
    std::fill(out + last, out + count, 1.0);
}

double pulse_spectrum(double x) noexcept {
    constexpr double kEnd = 60.0;
    constexpr std::size_t kSteps = 480;
    static const auto table = [] {
        std::array<double, kSteps + 2> out{};
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double w = kEnd * static_cast<double>(i) / kSteps;
            double sum = 0.0; // real: the pulse is even about its middle
            for (std::size_t c = 0; c < kCells; ++c) {
                const double u = (static_cast<double>(c) + 0.5) / kCells;
                sum += (pulse_share(u + 0.5 / kCells) - pulse_share(u - 0.5 / kCells)) *
                       std::cos(w * (u - 0.5));
            }
            out[i] = std::fabs(sum);
        }
        return out;
    }();
    if (!(x < kEnd))
        return 0.0;
    const double place = x / kEnd * kSteps;
    const auto i = static_cast<std::size_t>(place);
    return table[i] + (place - static_cast<double>(i)) * (table[i + 1] - table[i]);
}

} // namespace ode::sound
