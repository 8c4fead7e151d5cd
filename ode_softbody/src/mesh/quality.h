#pragma once

#include "mesh/tet_mesh.h"

#include <optional>

namespace ode::soft {

/// What a mesh is worth, told before anything is computed with it.
struct MeshQuality {
    double volume;      ///< [m^3]
    double min_volume;  ///< of the smallest element [m^3]
    double min_edge;    ///< [m]
    double max_edge;    ///< [m]
    double min_quality; ///< element_quality(): 1 regular, 0 flat
    std::size_t worst;  ///< element of min_quality
    std::size_t parts;  ///< pieces that share no node
    Vec3 low;           ///< bounding box [m]
    Vec3 high;          ///< bounding box [m]
};

/// Of a mesh that has passed check_mesh(). Volumes are exact for curved elements; edges and quality
/// are those of the corner tetrahedra.
MeshQuality measure_quality(const TetMesh& mesh);

/// Mean ratio 12 (3 |V|)^(2/3) / sum of squared edges of the corner tetrahedron, with the sign of
/// V: 1 regular, 0 flat, negative inverted (Liu and Joe 1994, doi:10.1007/BF01955874).
double element_quality(const TetMesh& mesh, std::size_t element);
double tetrahedron_quality(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);

/// Below this quality the sign of the volume is noise: corner coordinates carry a relative rounding
/// error of 1.1e-16, which makes an error of a few 1e-16 L^3 in V and of some 1e-10 in the quality.
inline constexpr double kFlatQuality = 1e-9;

/// What is wrong with a mesh, and where, so that a reader can name the line.
struct MeshFault {
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::size_t element = kNone; ///< kNone: not about one element
    std::size_t node = kNone;    ///< kNone: not about one node
    std::string text;            ///< "is flat (...): cure", to follow "element 3 " or "node 3 "
};

/// First fault, or nothing. See check_mesh().
std::optional<MeshFault> find_fault(const TetMesh& mesh);

/// Refuses what no solid can be made of: no element, an index out of range, a node used twice in an
/// element or by none, a number that is not finite, an inverted or flat element, elements that
/// overlap, a face of more than two elements, mid-edge nodes that neighbours do not share.
/// @param name  what to call the mesh in the sentence (a path, "mesh").
/// @throws InputError
void check_mesh(const TetMesh& mesh, const std::string& name);

} // namespace ode::soft
