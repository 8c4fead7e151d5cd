#include "plots/partials.h"

#include "plots/spectrogram.h"

#include <algorithm>
#include <cmath>

namespace plots {
namespace {

constexpr double kSurroundings = 200; // [cents] either side: wide enough to outweigh the line

/// Top of the parabola through a bin and its neighbours, in bins from the middle one. In dB a Hann
/// window's main lobe is close to a parabola: off by less than 0.02 bins.
double vertex(float left, float middle, float right) {
    const double curvature =
        static_cast<double>(left) - 2.0 * static_cast<double>(middle) + static_cast<double>(right);
    return curvature < 0 ? 0.5 * static_cast<double>(left - right) / curvature : 0.0;
}

} // namespace

std::vector<Partial> find_partials(std::span<const float> ring, double rate,
                                   std::span<const double> predicted, double reach, double clear) {
    const Spectrogram s = spectrum(ring, rate);
    const int last = s.rows - 2;
    // Bin of a frequency `cents` off.
    const auto bin = [&](double f, double cents) {
        return std::clamp(static_cast<int>(std::lround(f * std::exp2(cents / 1200) / s.row_height)),
                          1, last);
    };
    std::vector<Partial> out;
    std::vector<float> around;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        const double f = predicted[i];
        const auto level = s.level.begin();
        const auto top = std::max_element(level + bin(f, -reach), level + bin(f, reach) + 1);
        around.assign(level + bin(f, -kSurroundings), level + bin(f, kSurroundings) + 1);
        const auto median = around.begin() + std::ssize(around) / 2;
        std::nth_element(around.begin(), median, around.end());
        if (static_cast<double>(*top - *median) < clear || *top < top[-1] || *top < top[1])
            continue;
        const double heard =
            s.row_height * (static_cast<double>(top - level) + vertex(top[-1], top[0], top[1]));
        const bool below = i > 0 && heard - predicted[i - 1] < f - heard;
        const bool above = i + 1 < predicted.size() && predicted[i + 1] - heard <= heard - f;
        if (!below && !above)
            out.push_back({f, heard, static_cast<double>(*top)});
    }
    return out;
}

} // namespace plots
