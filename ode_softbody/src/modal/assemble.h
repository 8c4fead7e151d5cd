#pragma once

#include "modal/block_system.h"
#include "modal/dof_map.h"
#include "model/solid.h"

namespace ode::soft {

/// How inertia is shared out among the nodes.
enum class MassKind {
    kConsistent, ///< with the shape functions of displacement: best for modes
    kLumped,     ///< diagonal: a quarter of an element's mass a corner (order 1), or its consistent
                 ///< diagonal scaled to its mass (Hinton, Rock and Zienkiewicz 1976, HRZ)
};

/// Mass, volume and inertia of a body by quadrature over its elements.
struct MassProperties {
    double mass = 0;             ///< [kg]
    double volume = 0;           ///< [m^3]
    Vec3 centre = Vec3::Zero();  ///< centre of mass [m]
    Mat3 inertia = Mat3::Zero(); ///< about the centre of mass, mesh axes [kg m^2]
};

/// Refuses what has no modes: E or density not positive, Poisson's ratio outside (-1, 0.5), a group
/// without a solid.
/// @throws InputError
void check_solids(const TetMesh& mesh, std::span<const Solid> solids);

/// Small-strain isotropic elasticity at rest: K = int B^T C B, M = int rho N^T N, with the geometry
/// of the mesh (linear or quadratic) and the displacement of `map`. Linear displacement takes the
/// corners' straight geometry: on a curved one it would not hold rotations.
/// Same input, same bits: elements are added in order.
/// @param solids  by the mesh's group index; one for a mesh without groups.
/// @throws InputError when an element is inverted or flat.
BlockSystem assemble(const TetMesh& mesh, const DofMap& map, std::span<const Solid> solids,
                     MassKind mass = MassKind::kConsistent);

MassProperties mass_properties(const TetMesh& mesh, std::span<const Solid> solids);

} // namespace ode::soft
