#pragma once

#include <span>
#include <vector>

namespace plots {

/// A line of the spectrum beside the mode it was looked for at.
struct Partial {
    double predicted; ///< [Hz]
    double measured;  ///< [Hz], the line's top by a parabola through three bins
    double level;     ///< [dB re amplitude 1]
};

/// Finds predicted modes in a free ring. A mode counts as heard where the strongest line within
/// `reach` of it stands `clear` above the median level of its surroundings; a mode nobody struck is
/// left out, so a measured line near every prediction is evidence and its absence is none. A line
/// belongs to the prediction nearest to it: of a near-degenerate pair one is told.
/// @param ring   sound without an impact in it: an impact shifts phases and so splits lines
/// @param predicted  ascending [Hz]
/// @param reach  [cents]
/// @param clear  [dB]
std::vector<Partial> find_partials(std::span<const float> ring, double rate,
                                   std::span<const double> predicted, double reach = 50,
                                   double clear = 20);

} // namespace plots
