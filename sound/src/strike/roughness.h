#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ode::sound {

/// How the heights of a surface are spread over wavelengths.
struct Texture {
    /// Root mean square of the heights [m]. Of them 0.02 um are shorter than 0.8 mm, the cut-off of
    /// ISO 4288: grade N1 of ISO 1302 (0.025 um), polished, so that what weighs grams leaps little.
    double roughness = 5e-8;
    double longest = 5e-3;  ///< wavelength; longer ones are no higher [m]
    double shortest = 5e-5; ///< wavelength [m]
    unsigned seed = 1;
};

/// Heights along a line on a surface, over and over: a measured profile, or one of random phases
/// whose power falls with the square of the wave number, as that of most surfaces does (R. S.
/// Sayles, T. R. Thomas, Nature 271, 1978). The same for the same texture.
class Roughness {
public:
    explicit Roughness(const Texture& texture);
    /// @param height  [m], at equal distances `spacing` [m]; their mean is taken out.
    Roughness(std::span<const double> height, double spacing);

    /// Mean height over a stretch of at least the profile's spacing about a place [m]. What a
    /// contact of some width feels, and what a quick one hears without aliases.
    double mean(double place, double width) const noexcept;
    double period() const noexcept { return period_; } ///< [m]

private:
    void add_up(std::span<const double> height);
    double integral(double place) const noexcept;

    double spacing_, per_spacing_ = 0.0, period_ = 0.0;
    std::vector<double> height_; ///< the first once more behind the last [m]
    std::vector<double> sum_;    ///< of the heights up to each [m]
};

} // namespace ode::sound
