#pragma once

#include "base/types.h"
#include "model/block_matrix.h"

#include <Eigen/SparseCore>

#include <span>

namespace ode::soft {

/// How far the worst element is from rest, and the energy of all: by-products of the force, for the
/// watch over stability.
struct StrainExtremes {
    double min_jacobian = 1; ///< least det F; <= 0 means inverted
    double max_stretch = 1;  ///< upper bound of the largest principal stretch, from tr(F^T F)
    double energy = 0;       ///< elastic [J]; ElasticModel::energy() but for rounding
};

/// A deformable solid in space, discretised: everything an integrator needs to know of it.
/// Arrays are world frame, one 3-vector per mesh node, in the mesh's order.
class ElasticModel {
public:
    virtual ~ElasticModel() = default;

    virtual std::size_t node_count() const noexcept = 0;

    /// Lumped nodal mass [kg].
    virtual std::span<const double> mass() const noexcept = 0;

    /// Adds elastic and viscous nodal forces [N] to `force`. Allocates nothing.
    virtual StrainExtremes add_force(const NodeArray& position, const NodeArray& velocity,
                                     NodeArray& force) const noexcept = 0;

    /// Elastic energy [J].
    virtual double energy(const NodeArray& position) const noexcept = 0;

    /// A matrix of zeros with room for add_tangent().
    virtual BlockMatrix tangent_pattern() const = 0;

    /// Adds `elastic` K + `viscous` C: minus the derivatives of the elastic force by position and
    /// of the viscous force by velocity. Both symmetric; C is positive semidefinite.
    virtual void add_tangent(const NodeArray& position, double elastic, double viscous,
                             BlockMatrix& out) const noexcept = 0;

    /// K alone: symmetric, 3n x 3n, xyz of node 0, node 1, ... [N/m].
    Eigen::SparseMatrix<double> stiffness(const NodeArray& position) const {
        BlockMatrix k = tangent_pattern();
        add_tangent(position, 1, 0, k);
        return k.take();
    }

    /// Consistent mass, 3n x 3n [kg].
    virtual Eigen::SparseMatrix<double> consistent_mass() const = 0;

    /// Upper bound on the largest angular frequency at rest [rad/s], from the elements one by one
    /// (Irons-Treharne): never below the exact one.
    virtual double max_frequency_bound() const = 0;
};

} // namespace ode::soft
