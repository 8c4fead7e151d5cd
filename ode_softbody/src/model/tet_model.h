#pragma once

#include "base/isa.h"
#include "model/elastic_model.h"
#include "model/tet_element.h"

#include <span>

namespace ode::soft {

struct TetMesh;

/// Tetrahedra of one kind (Packs: Tet4Packs, Tet10Packs) under one constitutive law (StvkLaw, ...).
/// Definitions are in tet_model_impl.h, instances in the law's .cpp.
template <class Law, class Packs>
class TetModel final : public ElasticModel {
public:
    /// @param mesh   of the packs' order, passed by check_mesh(); not kept.
    /// @param solid  one a group of the mesh; one in all if it has no groups.
    /// @throws InputError
    TetModel(const TetMesh& mesh, std::span<const Solid> solid, Isa isa = active_isa());
    TetModel(const TetMesh& mesh, const Solid& solid, Isa isa = active_isa())
        : TetModel(mesh, std::span(&solid, 1), isa) {}

    std::size_t node_count() const noexcept override { return packs_.node_count(); }
    std::span<const double> mass() const noexcept override { return packs_.mass(); }
    StrainExtremes add_force(const NodeArray& position, const NodeArray& velocity,
                             NodeArray& force) const noexcept override;
    double energy(const NodeArray& position) const noexcept override;
    BlockMatrix tangent_pattern() const override;
    void add_tangent(const NodeArray& position, double elastic, double viscous,
                     BlockMatrix& out) const noexcept override;
    Eigen::SparseMatrix<double> consistent_mass() const override;
    double max_frequency_bound() const override;

private:
    using Constants = typename Law::Constants;
    struct Part {
        TetForce<Constants> add;
        Constants constants;
    };

    std::vector<int> connectivity() const;
    DeformationRange add_slab(std::size_t slab, const NodeArray& position,
                              const NodeArray& velocity, NodeArray& force) const noexcept;

    Packs packs_;
    std::vector<Part> part_;              ///< one a block
    std::vector<std::size_t> slab_begin_; ///< first block of each slab, and the number of blocks
};

} // namespace ode::soft
