#pragma once

#include "base/types.h"

#include <array>

namespace ode::soft {

using Tet = std::array<Vec3, 4>; ///< corners; positive volume

/// The polyhedron in which two tetrahedra overlap (P01 3.1): its volume, its middle, and by how
/// much the volume changes as corners move.
///
/// A face of either that bounds the polyhedron sweeps volume as its corners move: the derivative by
/// a corner is the integral of the corner's linear weight times the outward normal over the part of
/// the face inside the other. Over one tetrahedron's corners these sum to the area vector of its
/// surface inside the other, which is P01's area-weighted normal; the other's sum is opposite
/// because the polyhedron is closed.
struct TetOverlap {
    double volume;               ///< [m^3]
    Vec3 center;                 ///< centroid [m]
    std::array<Tet, 2> gradient; ///< [m^2]
};

/// @return false when they don't overlap; `out` is then untouched.
bool overlap_of(const Tet& a, const Tet& b, TetOverlap& out) noexcept;

/// How far before some face of either the whole other lies, at most [m]. Cheap. Above 0 they are
/// apart, by that at least; below, nothing is known.
double face_gap(const Tet& a, const Tet& b) noexcept;

} // namespace ode::soft
