#pragma once

#include "mesh/tet_mesh.h"
#include "model/tet10_shape.h"
#include "model/tet_element.h"

#include <Eigen/SparseCore>

#include <span>

namespace ode::soft {

/// Quadratic tetrahedra made ready for the force kernels; the quadratic counterpart of Tet4Packs.
/// Elements whose mid-edge nodes lie on the middle of straight edges (to 1e-9 of the edge) go into
/// packs of one Jacobian, curved ones keep the Jacobian of each Gauss point.
class Tet10Packs {
public:
    using Element = TetElement<10, 4>;

    /// @param mesh   of order 2, passed by check_mesh().
    /// @param solid  one a group of the mesh; one in all if it has no groups.
    /// @throws InputError when the order is not 2, a solid is missing or an element folds over: its
    ///         Jacobian is not positive at a Gauss point or a corner.
    Tet10Packs(const TetMesh& mesh, std::span<const Solid> solid);

    std::size_t node_count() const noexcept { return mass_.size(); }
    std::span<const TetBlock> blocks() const noexcept { return block_; }
    const void* pack(const TetBlock& block) const noexcept;
    Element element(const TetBlock& block, std::size_t e) const noexcept;

    /// Integrals of products of two shapes [m^3].
    Eigen::Matrix<double, 10, 10> shape_products(const Element& element) const noexcept;
    /// Volume whose mass each node carries [m^3]: the diagonal of shape_products(), scaled to the
    /// element's volume (Hinton, Rock & Zienkiewicz 1976, doi:10.1002/eqe.4290040305). Row sums,
    /// as for linear elements, would be negative at corners.
    Shapes10 lumped_volume(const Element& element) const noexcept;

    /// Lumped [kg].
    std::span<const double> mass() const noexcept { return mass_; }

private:
    void append(const TetMesh& mesh, const Solid& solid, std::size_t slab, TetShape shape,
                std::span<const int> elements);

    std::vector<TetBlock> block_;
    AlignedVector<Tet10Pack> straight_;
    AlignedVector<CurvedTet10Pack> curved_;
    std::vector<Vec3> rest_;
    std::vector<double> mass_;
};

} // namespace ode::soft
