#include "unit/model/specimens.h"

#include "model/stvk_lanes.h"
#include "model/stvk_linear.h"
#include "model/stvk_quadratic.h"
#include "model/tet10_lanes.h"

#include <gtest/gtest.h>

#include <cstring>

namespace ode::soft {
namespace {

class StvkKernel : public testing::TestWithParam<Isa> {};

// The scalar instance of the kernel template is the oracle. With fused multiply-add every lane does
// the same operations in the same order: equal bits. The baseline rounds each product as well: an
// element's force is a chain of some 30 roundings of terms up to lambda + 2 mu times an area, and a
// node adds up 24 elements.
template <class Packs>
void agrees_with_the_scalar_kernel(const TetMesh& mesh, const Solid& solid, Isa isa) {
    const TetModel<StvkLaw, Packs> model(mesh, solid, isa);
    const Packs packs(mesh, std::span(&solid, 1));
    const NodeArray x = disturbed(node_array(mesh.node), 0.004, 1);
    const NodeArray v = disturbed(NodeArray(x.size()), 5, 2);

    NodeArray wide(x.size()), one(x.size());
    const StrainExtremes extremes = model.add_force(x, v, wide);
    DeformationRange range{1e300, 0};
    for (const TetBlock& block : packs.blocks()) {
        const auto oracle =
            scalar::choose_kernel<scalar::Lane<1>, scalar::Stvk>(block.shape, solid.is_viscous());
        oracle(packs.pack(block), block.packs, StvkLaw::constants(solid), x.data(), v.data(),
               one.data(), range);
    }
    ASSERT_GT(peak(one), 1);
    if (isa == Isa::baseline) {
        const double tolerance = 24 * 30 * 1.1e-16 * (3 * solid.young) * 0.07 * 0.07;
        for (std::size_t i = 0; i < x.size(); ++i)
            EXPECT_LE((wide[i] - one[i]).norm(), tolerance);
        EXPECT_NEAR(extremes.min_jacobian, range.min_determinant, 1e-14);
    } else {
        EXPECT_EQ(std::memcmp(wide.data(), one.data(), 32 * x.size()), 0);
        EXPECT_EQ(extremes.min_jacobian, range.min_determinant);
    }
}

TEST_P(StvkKernel, AgreesWithTheScalarKernel) {
    if (!is_supported(GetParam()))
        GTEST_SKIP() << isa_name(GetParam());
    // 270 elements: not a multiple of the pack.
    const Vec3 size(0.3, 0.2, 0.2);
    const TetMesh linear = irregular_box(size, 5, 3, 3);
    const TetMesh straight = with_mid_nodes(linear);
    TetMesh curved = curved_box(size, 5, 3, 3, 0.003);
    for (std::size_t i = 0; i < curved.node.size(); ++i)
        if (straight.node[i].x() > 0.13)
            curved.node[i] = straight.node[i];
    ASSERT_EQ(Tet10Packs(curved, std::vector<Solid>{rubber()}).blocks().size(), 2u)
        << "straight and curved elements in one mesh";
    for (const Solid& solid : {rubber(), viscous_rubber()}) {
        agrees_with_the_scalar_kernel<Tet4Packs>(linear, solid, GetParam());
        agrees_with_the_scalar_kernel<Tet10Packs>(curved, solid, GetParam());
    }
}

INSTANTIATE_TEST_SUITE_P(All, StvkKernel, testing::Values(Isa::baseline, Isa::avx2, Isa::avx512),
                         [](const auto& instance) {
                             return std::string(isa_name(instance.param));
                         });

} // namespace
} // namespace ode::soft
