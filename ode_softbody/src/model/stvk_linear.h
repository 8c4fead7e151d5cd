#pragma once

#include "base/isa.h"
#include "model/elastic_model.h"
#include "model/tet4_packs.h"

namespace ode::soft {

/// The source paper's solid: linear tetrahedra, St. Venant-Kirchhoff with viscosity, lumped mass
/// (P01 3.1). Locks in bending: see StvkQuadratic for pitch.
class StvkLinear final : public ElasticModel {
public:
    /// @param mesh   of order 1, passed by check_mesh(); not kept.
    /// @param solid  one a group of the mesh; one in all if it has no groups.
    /// @throws InputError
    StvkLinear(const TetMesh& mesh, std::span<const Solid> solid, Isa isa = active_isa());
    StvkLinear(const TetMesh& mesh, const Solid& solid, Isa isa = active_isa())
        : StvkLinear(mesh, std::span(&solid, 1), isa) {}

    std::size_t node_count() const noexcept override { return packs_.node_count(); }
    std::span<const double> mass() const noexcept override { return packs_.mass(); }
    StrainExtremes add_force(const NodeArray& position, const NodeArray& velocity,
                             NodeArray& force) const noexcept override;
    double energy(const NodeArray& position) const noexcept override;
    Eigen::SparseMatrix<double> stiffness(const NodeArray& position) const override;
    Eigen::SparseMatrix<double> consistent_mass() const override {
        return packs_.consistent_mass();
    }
    double max_frequency_bound() const override;

private:
    Tet4Packs packs_;
    Tet4Force<StvkConstants> elastic_;
    Tet4Force<StvkConstants> viscous_;
};

} // namespace ode::soft
