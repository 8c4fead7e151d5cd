#include "strike/roughness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace ode::sound {
namespace {

/// Evenly spread from -1 to 1, by SplitMix64.
double random(std::uint64_t& state) noexcept {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

} // namespace

Roughness::Roughness(const Texture& texture) : spacing_(0.5 * texture.shortest) {
    // So long that nobody hears it come again.
    constexpr double kWaves = 64.0;
    constexpr double kMost = 1 << 17;
    const auto points = std::bit_ceil(
        static_cast<std::size_t>(std::clamp(kWaves * texture.longest / spacing_, 1024.0, kMost)));
    std::vector<double> height(points);
    std::uint64_t state = texture.seed;
    for (double& h : height)
        h = random(state);
    // White noise through a pole at the longest wavelength, twice round so that it closes.
    const double keep = std::exp(-2.0 * std::numbers::pi * spacing_ / texture.longest);
    double last = 0.0;
    for (int round = 0; round < 2; ++round) {
        std::uint64_t again = texture.seed;
        for (double& h : height)
            h = last = keep * last + (1.0 - keep) * random(again);
    }
    double mean = 0.0, square = 0.0;
    for (const double h : height)
        mean += h / static_cast<double>(points);
    for (const double h : height)
        square += (h - mean) * (h - mean) / static_cast<double>(points);
    const double scale = square > 0.0 ? texture.roughness / std::sqrt(square) : 0.0;
    for (double& h : height)
        h *= scale;
    add_up(height);
}

Roughness::Roughness(std::span<const double> height, double spacing) : spacing_(spacing) {
    add_up(height);
}

void Roughness::add_up(std::span<const double> height) {
    per_spacing_ = 1.0 / spacing_;
    period_ = spacing_ * static_cast<double>(height.size());
    double mean = 0.0;
    for (const double h : height)
        mean += h / static_cast<double>(height.size());
    height_.clear();
    for (const double h : height)
        height_.push_back(h - mean);
    height_.push_back(height_.front());
    sum_.assign(1, 0.0);
    for (std::size_t k = 0; k + 1 < height_.size(); ++k)
        sum_.push_back(sum_.back() + 0.5 * (height_[k] + height_[k + 1]));
}

/// Over the spacing: straight from height to height.
double Roughness::integral(double place) const noexcept {
    const double cell = place * per_spacing_;
    const double whole = std::floor(cell), t = cell - whole;
    // The sum over a period is nothing. Places are within a few periods.
    auto i = static_cast<std::int64_t>(whole);
    const auto cells = static_cast<std::int64_t>(sum_.size() - 1);
    while (i < 0)
        i += cells;
    while (i >= cells)
        i -= cells;
    const double* const h = height_.data() + i;
    return sum_[static_cast<std::size_t>(i)] + t * (h[0] + 0.5 * t * (h[1] - h[0]));
}

double Roughness::mean(double place, double width) const noexcept {
    const double w = std::max(width, spacing_);
    return (integral(place + 0.5 * w) - integral(place - 0.5 * w)) * spacing_ / w;
}

} // namespace ode::sound
