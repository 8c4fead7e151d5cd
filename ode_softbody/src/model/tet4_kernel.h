#pragma once

#include <cstddef>

namespace ode::soft {

/// Eight linear tetrahedra side by side, 96 bytes an element. Lists are filled up with copies of
/// their last element of volume 0.
struct alignas(64) Tet4Pack {
    static constexpr int kWidth = 8;

    double b[9][kWidth];      ///< Dm^-1, row-major: row j is the gradient of shape j+1 [1/m]
    double volume[kWidth];    ///< at rest [m^3]
    unsigned node[kWidth][4]; ///< offset of the node in a NodeArray [doubles]
};

/// Gathered over elements: least det F, greatest tr(F^T F).
struct DeformationRange {
    double min_determinant;
    double max_trace;
};

/// Constants of St. Venant-Kirchhoff with Kelvin-Voigt viscosity, as the kernels want them.
struct StvkConstants {
    double half_lambda; ///< lambda/2 [Pa]
    double mu;          ///< [Pa]
    double phi;         ///< viscous counterpart of lambda [Pa s]
    double psi;         ///< viscous counterpart of mu [Pa s]
};

/// Adds the forces of `count` packs to `force`; widens `range`. Arrays as NodeArray::data();
/// `velocity` is not read by elastic kernels.
template <class Constants>
using Tet4Force = void (*)(const Tet4Pack* pack, std::size_t count, const Constants& constants,
                           const double* position, const double* velocity, double* force,
                           DeformationRange& range);

} // namespace ode::soft
