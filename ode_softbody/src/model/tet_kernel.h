#pragma once

#include <cstddef>

namespace ode::soft {

// What force kernels and models share: plain data, no Eigen (see base/lane.h). Packs hold eight
// elements side by side; lists are filled up with copies of their last element of volume 0.
inline constexpr int kPackWidth = 8;

/// Linear tetrahedra, 96 bytes an element.
struct alignas(64) Tet4Pack {
    double b[9][kPackWidth];      ///< Dm^-1, row-major: row j is the gradient of shape j+1 [1/m]
    double volume[kPackWidth];    ///< at rest [m^3]
    unsigned node[kPackWidth][4]; ///< offset of the node in a NodeArray [doubles]
};

/// Quadratic tetrahedra with straight edges: one Jacobian. 120 bytes an element.
struct alignas(64) Tet10Pack {
    double b[9][kPackWidth];   ///< dL/dX of the corner coordinates L1 L2 L3, row-major [1/m]
    double volume[kPackWidth]; ///< at rest [m^3]
    unsigned node[kPackWidth][10];
};

/// Quadratic tetrahedra with curved edges: a Jacobian for each of four Gauss points, 360 bytes.
struct alignas(64) CurvedTet10Pack {
    double b[4][9][kPackWidth];   ///< dL/dX at the point [1/m]
    double volume[4][kPackWidth]; ///< share of the point, at rest [m^3]
    unsigned node[kPackWidth][10];
};

enum class TetShape { linear, quadratic, curved };

/// The four-point rule of degree 2: point q has L_q = kGaussNear, the other coordinates kGaussFar.
inline constexpr double kGaussNear = 0.58541019662496845446; // (5 + 3 sqrt 5) / 20
inline constexpr double kGaussFar = 0.13819660112501051518;  // (5 - sqrt 5) / 20

/// Number of the mid-edge node between two corners.
inline constexpr int kMidNode[4][4] = {{-1, 4, 6, 7}, {4, -1, 5, 8}, {6, 5, -1, 9}, {7, 8, 9, -1}};

/// Gathered over elements: least det F, greatest tr(F^T F), elastic energy [J].
struct DeformationRange {
    double min_determinant;
    double max_trace;
    double energy = 0;
};

/// Adds the forces of `count` packs to `force`; widens `range`, its energy grows. `pack` is of the
/// shape's type, arrays are as NodeArray::data(); `velocity` is not read by elastic kernels.
template <class Constants>
using TetForce = void (*)(const void* pack, std::size_t count, const Constants& constants,
                          const double* position, const double* velocity, double* force,
                          DeformationRange& range);

} // namespace ode::soft
