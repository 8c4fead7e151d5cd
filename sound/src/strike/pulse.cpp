#include "strike/pulse.h"

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

} // namespace

double pulse_share(double u) noexcept {
    if (!(u > 0.0))
        return 0.0;
    if (u >= 1.0)
        return 1.0;
    const Table& course = table();
    const double place = u * kCells;
    const auto c = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(c), h = 1.0 / kCells;
    const double a = course.share[c], b = course.share[c + 1];
    const double da = h * course.force[c], db = h * course.force[c + 1];
    return a + t * (da + t * (3.0 * (b - a) - 2.0 * da - db + t * (2.0 * (a - b) + da + db)));
}

namespace {

/// Spectrum and slope at steps of x, cubics between them; cells taken at their middles err by 1e-5.
class Spectrum {
public:
    static constexpr double kEnd = 60.0;
    static constexpr std::size_t kSteps = 480;
    static constexpr double kStep = kEnd / kSteps;

    Spectrum() {
        for (std::size_t i = 0; i < value.size(); ++i) {
            const double w = kStep * static_cast<double>(i);
            for (std::size_t c = 0; c < kCells; ++c) { // real: the pulse is even about its middle
                const double u = (static_cast<double>(c) + 0.5) / kCells;
                const double part = pulse_share(u + 0.5 / kCells) - pulse_share(u - 0.5 / kCells);
                value[i] += part * std::cos(w * (u - 0.5));
                slope[i] -= part * (u - 0.5) * std::sin(w * (u - 0.5));
            }
        }
    }

    std::array<double, kSteps + 2> value{}, slope{};
};

const Spectrum& spectrum() {
    static const Spectrum made;
    return made;
}

} // namespace

PulseSpectrum pulse_spectrum(double x) noexcept {
    if (!(x < Spectrum::kEnd))
        return {};
    const Spectrum& table = spectrum();
    const double place = x / Spectrum::kStep;
    const auto i = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(i);
    const double a = table.value[i], b = table.value[i + 1];
    const double da = Spectrum::kStep * table.slope[i], db = Spectrum::kStep * table.slope[i + 1];
    const double square = 3.0 * (b - a) - 2.0 * da - db, cube = 2.0 * (a - b) + da + db;
    return {a + t * (da + t * (square + t * cube)),
            (da + t * (2.0 * square + t * 3.0 * cube)) / Spectrum::kStep};
}

} // namespace ode::sound
