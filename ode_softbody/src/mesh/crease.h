#pragma once

#include "mesh/tet_mesh.h"

#include <array>
#include <optional>

namespace ode::soft {

/// An edge of the facets of a body, between its corner nodes.
struct FacetEdge {
    std::array<int, 2> node; ///< ascending
    double dihedral;         ///< between the outward normals of its facets [rad]
    bool crease;             ///< sharp, or shared by more facets than two
    /// Fan of each end that the edge lies in; of no meaning on a crease.
    std::array<int, 2> fan;
};

/// How far a normal can be trusted where surfaces of a body meet.
enum class NormalRank { raw, on_crease, inner };

/// The facets round a node between two creases, or all round it: one smooth piece of surface.
struct Fan {
    Vec3 normal;     ///< outward, of unit length
    NormalRank rank; ///< inner: all round the node; on_crease: made normal to the crease's tangent
};

/// The facets of a body divided by creases.
struct CreasedSurface {
    std::vector<FacetEdge> edge; ///< ascending by node
    std::vector<Fan> fan;
    /// At nodes in the run of a crease: unit tangent, either way; at others nothing.
    std::vector<std::optional<Vec3>> tangent;
};

/// Normals are those of Max 1999 (doi:10.1080/10867651.1999.10487501), exact on spheres; tangents
/// those of the circle through a node and its two neighbours on the crease.
/// @param crease_angle  dihedral [rad] from which an edge is meant to be sharp
CreasedSurface divide_at_creases(const TetMesh& mesh, double crease_angle);

} // namespace ode::soft
