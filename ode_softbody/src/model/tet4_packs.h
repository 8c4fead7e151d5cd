#pragma once

#include "mesh/tet_mesh.h"
#include "model/tet_element.h"

#include <Eigen/SparseCore>

#include <span>

namespace ode::soft {

/// Linear tetrahedra made ready for the force kernels, with what does not depend on the
/// constitutive law. Elements are in the order of order_elements(); nodes keep the mesh's numbers.
class Tet4Packs {
public:
    using Element = TetElement<4, 1>;

    /// @param mesh   of order 1, passed by check_mesh().
    /// @param solid  one a group of the mesh; one in all if it has no groups.
    /// @throws InputError when the order is not 1, a solid is missing or an element is inverted.
    Tet4Packs(const TetMesh& mesh, std::span<const Solid> solid);

    std::size_t node_count() const noexcept { return mass_.size(); }
    std::span<const TetBlock> blocks() const noexcept { return block_; }
    const void* pack(const TetBlock& block) const noexcept { return pack_.data() + block.first; }
    Element element(const TetBlock& block, std::size_t e) const noexcept;

    /// Volume whose mass each node of an element carries [m^3]: V0 / 4.
    Eigen::Vector4d lumped_volume(const Element& element) const noexcept;
    /// Integrals of products of two shapes [m^3]: V0 / 20, twice that for one with itself.
    Eigen::Matrix4d shape_products(const Element& element) const noexcept;

    /// Lumped [kg].
    std::span<const double> mass() const noexcept { return mass_; }

private:
    void append(const TetMesh& mesh, const Solid& solid, std::size_t slab,
                std::span<const int> elements);

    std::vector<TetBlock> block_;
    AlignedVector<Tet4Pack> pack_;
    std::vector<double> mass_;
};

} // namespace ode::soft
