#pragma once

#include "modal/solve_modes.h"

#include <functional>
#include <string>
#include <vector>

namespace ode::soft {

/// A body for judging pitch: coarse meshes of things that sound, chosen for what is hard about
/// them.
struct PitchCase {
    std::string name;
    /// Its facets are the geometry. Quadratic, with straight edges, where an edge from one clamped
    /// face to another must not count as clamped.
    TetMesh mesh;
    std::vector<Solid> solids;
    std::function<bool(const Vec3&)> clamped; ///< empty: free
    double max_frequency;                     ///< [Hz] partials are compared up to here
    /// Where refined(mesh) isn't good enough for a reference: another mesh of the body, matched by
    /// rank. Else empty.
    TetMesh reference = {};
    std::size_t partials = 10; ///< the lowest so many
};

/// The bodies on which the constants of the band (modal/pitch.cpp) were chosen.
std::vector<PitchCase> pitch_cases();
/// Bodies on which they are only tested.
std::vector<PitchCase> held_out_cases();

/// The options of a case, without order.
ModalOptions options_for(const PitchCase& pitch_case, const TetMesh& mesh);

/// Each tetrahedron cut into eight: same geometry, the old nodes first.
TetMesh refined(const TetMesh& mesh);

/// For each mode of `coarse`, the frequency in `fine` of the same shape on the first nodes [Hz],
/// by modal assurance (MAC, Allemang 1982); members of a pair share one. 0 where no shape agrees.
std::vector<double> matched_frequencies(const ModalModel& coarse, const ModalModel& fine);

} // namespace ode::soft
