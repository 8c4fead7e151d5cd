#pragma once

#include "mesh/tet_mesh.h"
#include "model/solid.h"
#include "model/tet4_kernel.h"

#include <Eigen/SparseCore>

#include <span>

namespace ode::soft {

/// Linear tetrahedra made ready for the force kernels, with what does not depend on the
/// constitutive law. Elements are sorted by solid, then for the cache; nodes keep the mesh's
/// numbers.
class Tet4Packs {
public:
    /// Elements of one solid.
    struct Block {
        Solid solid;
        std::size_t first; ///< pack
        std::size_t packs;
        std::size_t elements; ///< without the filling of the last pack
    };

    /// One element, unpacked.
    struct Element {
        int node[4];
        Eigen::Matrix<double, 4, 3> gradient; ///< of the four shapes [1/m]
        double volume;                        ///< [m^3]
    };

    /// @param mesh   of order 1, passed by check_mesh().
    /// @param solid  one a group of the mesh; one in all if it has no groups.
    /// @throws InputError when the order is not 1, a solid is missing or an element is inverted.
    Tet4Packs(const TetMesh& mesh, std::span<const Solid> solid);

    std::size_t node_count() const noexcept { return mass_.size(); }
    std::span<const Block> blocks() const noexcept { return block_; }
    const Tet4Pack* pack(const Block& block) const noexcept { return pack_.data() + block.first; }
    Element element(const Block& block, std::size_t e) const noexcept;

    /// Lumped: rho V0 / 4 a corner [kg].
    std::span<const double> mass() const noexcept { return mass_; }

    /// rho V0 / 20 between two corners, twice that at each [kg]; 3n x 3n.
    Eigen::SparseMatrix<double> consistent_mass() const;

    /// Node numbers of all elements, four each, in the order of the packs.
    std::vector<int> connectivity() const;

private:
    std::vector<Block> block_;
    AlignedVector<Tet4Pack> pack_;
    std::vector<double> mass_;
};

/// F = sum x_a (x) grad N_a.
Mat3 deformation_gradient(const Tet4Packs::Element& element, const NodeArray& position) noexcept;

} // namespace ode::soft
