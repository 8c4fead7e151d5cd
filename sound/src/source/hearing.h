#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ode::sound {

/// The softest tone that is heard, in a free field, both ears: ISO 389-7:2005, straight lines over
/// the logarithm of frequency; as at its ends beyond them.
/// @return rms [Pa].
inline double hearing_threshold(double hertz) noexcept {
    struct Point {
        double hertz, level; ///< [dB re 20 uPa]
    };
    constexpr Point kTable[] = {
        {20, 78.5},    {31.5, 59.5},  {50, 44.0},    {80, 31.5},    {125, 22.1},
        {200, 14.4},   {315, 8.6},    {500, 4.4},    {800, 2.2},    {1000, 2.4},
        {1250, 3.5},   {1600, 1.7},   {2000, -1.3},  {2500, -4.2},  {3150, -6.0},
        {4000, -5.4},  {5000, -1.5},  {6300, 6.0},   {8000, 12.6},  {9000, 13.9},
        {10000, 13.9}, {12500, 12.3}, {14000, 18.4}, {16000, 40.2}, {18000, 73.2}};
    constexpr std::size_t kLast = sizeof kTable / sizeof kTable[0] - 1;
    std::size_t i = 0;
    while (i + 1 < kLast && kTable[i + 1].hertz < hertz)
        ++i;
    const Point &a = kTable[i], &b = kTable[i + 1];
    const double f = std::clamp(hertz, kTable[0].hertz, kTable[kLast].hertz);
    const double level =
        a.level + (b.level - a.level) * std::log(f / a.hertz) / std::log(b.hertz / a.hertz);
    return 2e-5 * std::pow(10.0, level / 20.0);
}

} // namespace ode::sound
