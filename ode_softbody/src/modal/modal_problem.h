#pragma once

#include "modal/block_lanczos.h"
#include "modal/solve_modes.h"

#include <cmath>
#include <memory>
#include <numbers>

namespace ode::soft {

/// The steps of a modal analysis one by one, for those who need what lies between: the factor, the
/// matrices, the vectors on all nodes.
class ModalProblem {
public:
    /// Checks, numbers and assembles. Mesh, solids and options are borrowed for the object's life.
    ModalProblem(const TetMesh& mesh, std::span<const Solid> solids, const ModalOptions& options);

    /// Multiplications and additions of the factor: what a direct solution would cost.
    double factor_flops();

    /// Factorises, finds all pairs wanted and verifies their number. Pairs without strain energy
    /// are taken out and added to rigid_modes().
    EigenPairs solve();

    /// Elastic modes below an eigenvalue by Sylvester's law of inertia: a factorisation of which
    /// nothing is kept. The rigid_modes() are not among them.
    Eigen::Index modes_below(double eigenvalue);

    /// Rayleigh quotients, mass normalisation, sign; shapes on the mesh's own nodes.
    ModalModel model(const EigenPairs& pairs) const;

    const DofMap& map() const noexcept { return map_; }
    const BlockSystem& system() const noexcept { return system_; }   ///< of free nodes
    const std::vector<char>& held() const noexcept { return held_; } ///< see free_rigid_motions
    const RowMatrix& rigid_motions() const noexcept { return rigid_; }
    /// Row of each mesh node's x in the system; -1: held, in no element, or no node of the map.
    std::vector<Eigen::Index> mesh_rows() const;
    const BlockFactor& factor() const noexcept { return *factor_; } ///< after solve()
    const TetMesh& mesh() const noexcept { return mesh_; }
    std::span<const Solid> solids() const noexcept { return solids_; }
    double shift() const noexcept { return shift_; }
    int rigid_modes() const noexcept { return rigid_modes_; }

    void adopt_rigid_modes(const ModalProblem& other) { rigid_modes_ = other.rigid_modes_; }

    /// Reports progress. @throws Cancelled
    void tell(const char* stage, double share, std::size_t modes = 0) const;

private:
    void hold(std::span<const int> mesh_nodes, char axes);
    bool verify(EigenPairs& pairs, unsigned seed, LanczosOptions lanczos);

    const TetMesh& mesh_;
    std::span<const Solid> solids_;
    const ModalOptions& options_;
    DofMap map_;
    std::vector<char> held_;
    BlockSystem system_;
    RowMatrix rigid_;
    std::unique_ptr<BlockFactor> factor_;
    double shift_ = 0;
    int rigid_modes_ = 0;
};

/// lambda = (2 pi f)^2.
inline double eigenvalue_of(double frequency) {
    const double w = 2 * std::numbers::pi * frequency;
    return w * w;
}
inline double frequency_of(double eigenvalue) {
    return eigenvalue > 0 ? std::sqrt(eigenvalue) / (2 * std::numbers::pi) : 0.0;
}

} // namespace ode::soft
