#pragma once

#include "modal/modal_model.h"

#include <array>
#include <functional>

namespace ode::soft {

/// Where a modal analysis stands.
struct ModalProgress {
    const char* stage; ///< "assemble", "factorise", "modes", "verify", "cubic"
    double share;      ///< of this stage [0, 1]
    std::size_t modes; ///< found so far
};

struct ModalOptions {
    int order = 3; ///< of the displacement: 1, 2 or 3, whatever the mesh
    MassKind mass = MassKind::kConsistent;
    double max_frequency = 22000;            ///< [Hz] all modes up to here
    std::size_t max_modes = 0;               ///< lowest ones only; 0: no limit
    std::vector<int> clamped;                ///< mesh nodes held still (see clamped_nodes)
    std::array<std::vector<int>, 3> rollers; ///< mesh nodes held along x, y, z only
    bool clamp = false;                      ///< a clamp is meant: an empty `clamped` is an error
    bool estimate = true;                    ///< give ModalModel::error_cents
    bool rebuilt_curves = false;             ///< the mesh's curved edges were guessed from facets
    /// With rebuilt_curves: where the mesh's nodes lie on the facets. Empty: mid-edge nodes
    /// halfway.
    std::vector<Vec3> facets;
    bool verify = true;                        ///< count the modes by Sylvester's law of inertia
    std::size_t memory = std::size_t{6} << 30; ///< refuse what would need more [bytes]
    std::function<bool(const ModalProgress&)> progress; ///< false cancels
};

/// Natural frequencies and shapes of a linear elastic body at rest.
///
/// With an estimate, the same mesh is solved one order higher too. The change d of a partial
/// [cents], plus the spread of neighbours that its shape mixes, tells its error: order 3 gives
/// f3 - 1.4 (f3 - f4) with the band 0.45 d; orders 1 and 2 give their own f with the band 2 d.
/// Where the quartic order is too large, the quadratic one judges the cubic: f3 - 0.1 (f2 - f3),
/// band (f2 - f3) / 2, generous. Curves rebuilt from facets add 0.3 of
/// what straight facets would change. tests/physics/modal/band_test.cpp holds the figures. The band
/// holds the error of discretisation only: not of the material's constants, nor of a mesh that
/// isn't the object, nor of a clamp that catches both ends of an edge which it should not (give a
/// quadratic mesh there: its middles are listed one by one).
///
/// Free motions are known exactly and kept out, so they never leak into the lowest modes; anything
/// else without strain energy (two parts that touch along an edge) is counted in rigid_modes.
/// Shapes of equal frequencies are any basis of their space, the same on each run. The sign makes
/// the largest component positive.
/// @param solids  by the mesh's group index
/// @throws InputError naming what is wrong and what to do; Cancelled when progress returns false.
ModalModel solve_modes(const TetMesh& mesh, std::span<const Solid> solids,
                       const ModalOptions& options = {});

} // namespace ode::soft
