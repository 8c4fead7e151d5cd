#pragma once

#include "mesh/tet_mesh.h"

namespace ode::soft {

/// What a mesh is worth, told before anything is computed with it.
struct MeshQuality {
    double volume;            ///< [m^3]
    double min_volume;        ///< of the smallest element [m^3]
    double min_edge;          ///< [m]
    double max_edge;          ///< [m]
    double min_quality;       ///< 12 (3 V)^(2/3) / sum of squared edges: 1 regular, 0 flat
    std::size_t worst;        ///< element of min_quality
    std::size_t parts;        ///< pieces that share no node
    Vec3 low;                 ///< bounding box [m]
    Vec3 high;                ///< bounding box [m]
};

MeshQuality measure_quality(const TetMesh& mesh);

/// Refuses what no solid can be made of: no element, an index out of range, a node used twice in an
/// element, a number that is not finite, an inverted or flat element.
/// @param name  what to call the mesh in the sentence (a path, "mesh").
/// @throws InputError
void check_mesh(const TetMesh& mesh, const std::string& name);

} // namespace ode::soft
