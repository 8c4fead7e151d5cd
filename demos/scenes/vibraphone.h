#pragma once

#include "scenes/world.h"

namespace scenes {

/// A vibraphone bar of 36 cm, 50 x 14.6 mm, hollowed out below: its thickness is 5.03 mm in the
/// middle and grows as the cube of the way from there up to 110 mm, which tunes its bending to 1 :
/// 4 : 10 at 185 Hz in aluminium (found by softsound's own modes of consistent quadratic elements).
/// Along x from 0, top at z = 7.3 mm.
/// @param cells  along its length
ode::soft::MeshHandle vibraphone_bar(int cells);
/// Height of its lower face at a place along it [m].
double vibraphone_underside(double x);
constexpr double kVibraphoneLength = 0.36, kVibraphoneWidth = 0.05, kVibraphoneHeight = 0.0146;

} // namespace scenes
