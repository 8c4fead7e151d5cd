#include "model/stvk_linear.h"

#include "model/block_matrix.h"
#include "model/element_frequency.h"
#include "model/strain_extremes.h"
#include "model/stvk.h"

namespace ode::soft {

namespace baseline {
Tet4Force<StvkConstants> stvk_tet4(bool viscous);
}
#if defined(__x86_64__)
namespace avx2 {
Tet4Force<StvkConstants> stvk_tet4(bool viscous);
}
namespace avx512 {
Tet4Force<StvkConstants> stvk_tet4(bool viscous);
}
#endif

namespace {

Tet4Force<StvkConstants> kernel(Isa isa, bool viscous) {
    switch (isa) {
#if defined(__x86_64__)
    case Isa::avx512:
        return avx512::stvk_tet4(viscous);
    case Isa::avx2:
        return avx2::stvk_tet4(viscous);
#endif
    default:
        return baseline::stvk_tet4(viscous);
    }
}

} // namespace

StvkLinear::StvkLinear(const TetMesh& mesh, std::span<const Solid> solid, Isa isa)
    : packs_(mesh, solid), elastic_(kernel(isa, false)), viscous_(kernel(isa, true)) {}

StrainExtremes StvkLinear::add_force(const NodeArray& position, const NodeArray& velocity,
                                     NodeArray& force) const noexcept {
    DeformationRange range = kNoDeformation;
    for (const Tet4Packs::Block& block : packs_.blocks()) {
        const auto add = block.solid.is_viscous() ? viscous_ : elastic_;
        add(packs_.pack(block), block.packs, stvk_constants(block.solid), position.data(),
            velocity.data(), force.data(), range);
    }
    return strain_extremes(range);
}

double StvkLinear::energy(const NodeArray& position) const noexcept {
    double sum = 0;
    for (const Tet4Packs::Block& block : packs_.blocks())
        for (std::size_t e = 0; e < block.elements; ++e) {
            const auto element = packs_.element(block, e);
            sum +=
                element.volume * stvk_energy(block.solid, deformation_gradient(element, position));
        }
    return sum;
}

Eigen::SparseMatrix<double> StvkLinear::stiffness(const NodeArray& position) const {
    BlockMatrix k(packs_.connectivity(), 4, node_count());
    for (const Tet4Packs::Block& block : packs_.blocks())
        for (std::size_t e = 0; e < block.elements; ++e) {
            const auto element = packs_.element(block, e);
            const StvkTangent tangent(block.solid, deformation_gradient(element, position));
            for (int a = 0; a < 4; ++a)
                for (int b = 0; b < 4; ++b)
                    k.add(element.node[a], element.node[b],
                          element.volume *
                              tangent.block(element.gradient.row(a), element.gradient.row(b)));
        }
    return k.take();
}

double StvkLinear::max_frequency_bound() const {
    ElementFrequency bound;
    for (const Tet4Packs::Block& block : packs_.blocks()) {
        const StvkTangent tangent(block.solid, Mat3::Identity());
        for (std::size_t e = 0; e < block.elements; ++e) {
            const auto element = packs_.element(block, e);
            Eigen::Matrix<double, 12, 12> k; // of unit volume: it cancels against the mass
            for (int a = 0; a < 4; ++a)
                for (int b = 0; b < 4; ++b)
                    k.block<3, 3>(3 * a, 3 * b) =
                        tangent.block(element.gradient.row(a), element.gradient.row(b));
            bound.include<12>(k / (block.solid.density / 4));
        }
    }
    return bound.value();
}

} // namespace ode::soft
