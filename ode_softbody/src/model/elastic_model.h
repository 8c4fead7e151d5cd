#pragma once

#include "base/types.h"

#include <Eigen/SparseCore>

#include <span>

namespace ode::soft {

/// How far the worst element is from rest: by-products of the force, for the watch over stability.
struct StrainExtremes {
    double min_jacobian = 1; ///< least det F; <= 0 means inverted
    double max_stretch = 1;  ///< upper bound of the largest principal stretch, from tr(F^T F)
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

    /// Derivative of minus the elastic force: symmetric, 3n x 3n, xyz of node 0, node 1, ... [N/m].
    virtual Eigen::SparseMatrix<double> stiffness(const NodeArray& position) const = 0;

    /// Consistent mass, 3n x 3n [kg].
    virtual Eigen::SparseMatrix<double> consistent_mass() const = 0;

    /// Upper bound on the largest angular frequency at rest [rad/s], from the elements one by one
    /// (Irons-Treharne): never below the exact one.
    virtual double max_frequency_bound() const = 0;
};

} // namespace ode::soft
