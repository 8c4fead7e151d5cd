#pragma once

#include <cstddef>

namespace ode::soft {

inline constexpr double kAudible = 22000; ///< [Hz]
inline constexpr std::size_t kMostModes =
    500; ///< a body with more is soft: it deforms rather than rings
// Modes up to here take part in contact, whose pulses are far shorter than the shortest period that
// is heard: with those heard alone, a blow errs by 16 % (tests/physics/tier/fall_test.cpp).
inline constexpr double kContactBand = 3.5 * kAudible;
inline constexpr double kLeastBand = 3 * kAudible; ///< where that takes more than kMostModes

// What moves gently is pushed by forces that move no higher mode.
inline constexpr double kGentleBand = 2 * kAudible;

} // namespace ode::soft
