#pragma once

#include "scenes/timoshenko.h"

#include <array>
#include <vector>

namespace ode::soft {

/// Wind chimes that were measured (NORSIG 2004), four tubes of one set: partials [Hz].
inline constexpr std::array<std::array<double, 4>, 4> kMeasuredChimes = {{{244, 663, 1272, 2050},
                                                                          {278, 753, 1441, 2314},
                                                                          {312, 850, 1625, 2600},
                                                                          {330, 890, 1700, 2712}}};

/// What Timoshenko's beam makes of that set. Partial 1 gives each tube its length, up to a scale,
/// because f1 goes as 1 / L^2; the one parameter left, the radius of gyration over the first one's
/// length, is fitted on a single number, that chime's second partial.
class MeasuredChimes {
public:
    /// Thin tube: Cowper's k = 2 (1 + nu) / (4 + 3 nu), so E / (k G) = 4 + 3 nu.
    static constexpr double kShear = 4 + 3 * 0.33;

    MeasuredChimes()
        : slenderness_(roots(
              [](double r) {
                  const auto b = timoshenko_roots(BeamEnds::kFree, r * r, r * r * kShear, 2);
                  return b[1] / b[0] - kMeasuredChimes[0][1] / kMeasuredChimes[0][0];
              },
              0.002, 0.002, 1)[0]) {}

    double slenderness() const { return slenderness_; } ///< of the first

    /// Partials of a tube of the set that has this first one [Hz].
    std::vector<double> partials(double first) const {
        const double r2 = slenderness_ * slenderness_ * first / kMeasuredChimes[0][0];
        std::vector<double> out = timoshenko_roots(BeamEnds::kFree, r2, r2 * kShear, 4);
        const double scale = first / out[0];
        for (double& b : out)
            b *= scale;
        return out;
    }

private:
    double slenderness_;
};

} // namespace ode::soft
