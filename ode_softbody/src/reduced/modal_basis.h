#pragma once

#include "base/types.h"
#include "modal/modal_model.h"

#include <span>
#include <vector>

namespace ode::soft {

/// What each mesh node yields to a steady force beyond what rigid motion and the modes do [m/N].
struct ResidualFlexibility {
    std::vector<double> normal; ///< along its surface normal
    std::vector<double> across; ///< along the surface
};

/// What a body's vibrations are made of, as plain data that any number of like bodies share: its
/// modes in the body's own frame, laid out for the two products that motion needs, places of nodes
/// from amplitudes and forces on amplitudes from forces on nodes.
///
/// The frame's origin is the centre of mass, its axes are the mesh's. Columns are padded to
/// kLanes with modes that never move.
struct ModalBasis {
    static constexpr std::size_t kLanes = 8;

    /// Two modes that a spin turns into one another: sum of m phi_i x phi_j over the nodes.
    struct Gyration {
        int first, second;
        Vec3 coupling; ///< [-]
        double spin;   ///< at which it may be as large as the gap between them [rad/s]
    };

    std::size_t modes = 0;   ///< without padding
    std::size_t columns = 0; ///< with
    std::size_t audible = 0; ///< of the modes, the first: what lies above is there for contact
    std::size_t audible_columns = 0; ///< whole lanes that hold these
    std::size_t gentle_columns = 0;  ///< as many as gentle contact moves, whole lanes
    std::vector<Vec3> rest;          ///< of each node [m]
    std::vector<double> mass;        ///< of each node [kg]
    double radius = 0;               ///< of the farthest node from the origin [m]
    double total_mass = 0;           ///< [kg]
    Mat3 inertia = Mat3::Zero();     ///< of the body at rest [kg m^2]
    AlignedVector<double> omega;     ///< undamped [rad/s], one a column
    AlignedVector<double> decay;     ///< of amplitudes [1/s]
    /// Row 3 n + axis: of node n along the axis [kg^-1/2]. Displacements are small: their last
    /// digits are of no place in the world, and both products use the same numbers, so that what
    /// contact gives the modes is what it sees them do.
    AlignedVector<float> shape;
    AlignedVector<double> reach;    ///< largest displacement of a node at unit amplitude [kg^-1/2]
    std::vector<Gyration> gyration; ///< by rising spin
    /// First derivative of the inertia by each amplitude: xx, yy, zz, xy, xz, yz rows of `columns`
    /// [kg^1/2 m].
    AlignedVector<double> inertia_slope;
    /// Sum of m phi: three rows of `columns` [kg^1/2]; zero of a body that nothing holds.
    AlignedVector<double> inertia_share;
    ResidualFlexibility residual;        ///< 0 inside and where held
    ResidualFlexibility gentle_residual; ///< beyond the gentle columns
    bool held = false;                   ///< some nodes are: there is no rigid motion

    std::size_t nodes() const noexcept { return rest.size(); }
    const float* row(std::size_t node, std::size_t axis) const noexcept {
        return shape.data() + (3 * node + axis) * columns;
    }
};

/// Surface nodes and the outward directions that they are pushed along.
struct PushedNodes {
    std::span<const int> node;
    std::span<const Vec3> normal;
};

/// @param position  of nodes at rest, mesh frame [m]
/// @param mass      lumped, of each node: what `modes` were found with [kg]
/// @param decay     of each mode [1/s]
/// @param audible_limit  frequency up to which they are heard [Hz]
/// @param gentle_limit   frequency up to which gentle contact moves them [Hz]
/// The residual flexibilities are left empty.
ModalBasis make_basis(const ModalModel& modes, std::span<const Vec3> position,
                      std::span<const double> mass, std::span<const double> decay,
                      double audible_limit, double gentle_limit, bool held);

} // namespace ode::soft
