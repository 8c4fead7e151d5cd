#include "model/stvk_linear.h"

#include "base/error.h"
#include "unit/model/specimens.h"

#include "model/stvk.h"
#include "model/stvk_lanes.h"
#include "model/tet4_lanes.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

class StvkLinearIsa : public testing::TestWithParam<Isa> {};

// The scalar instance of the kernel template is the oracle. With fused multiply-add every lane does
// the same operations in the same order: equal bits. The baseline rounds each product as well: an
// element's force is a chain of about 20 roundings of terms up to lambda + 2 mu times an area.
TEST_P(StvkLinearIsa, AgreesWithTheScalarKernel) {
    if (!is_supported(GetParam()))
        GTEST_SKIP() << isa_name(GetParam());
    for (const bool viscous : {false, true}) {
        const Solid solid = viscous ? viscous_rubber() : rubber();
        const TetMesh mesh = irregular_box({0.3, 0.2, 0.2}, 5, 3, 3); // 270: not a multiple of 8
        const StvkLinear model(mesh, solid, GetParam());
        const Tet4Packs packs(mesh, std::span(&solid, 1));
        const NodeArray x = disturbed(node_array(mesh.node), 0.008, 1);
        const NodeArray v = disturbed(NodeArray(x.size()), 5, 2);

        NodeArray wide(x.size()), one(x.size());
        const StrainExtremes extremes = model.add_force(x, v, wide);
        DeformationRange range{1e300, 0};
        const auto oracle = viscous ? scalar::add_tet4_force<scalar::Lane<1>, scalar::Stvk, true>
                                    : scalar::add_tet4_force<scalar::Lane<1>, scalar::Stvk, false>;
        const auto& block = packs.blocks()[0];
        oracle(packs.pack(block), block.packs, stvk_constants(solid), x.data(), v.data(),
               one.data(), range);

        if (GetParam() == Isa::baseline) {
            const double tolerance = 100 * 1.2e-16 * (3 * solid.young) * 0.1 * 0.1;
            for (std::size_t i = 0; i < x.size(); ++i)
                EXPECT_LE((wide[i] - one[i]).norm(), tolerance);
            EXPECT_NEAR(extremes.min_jacobian, range.min_determinant, 1e-14);
        } else {
            EXPECT_EQ(std::memcmp(wide.data(), one.data(), 32 * x.size()), 0);
            EXPECT_EQ(extremes.min_jacobian, range.min_determinant);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, StvkLinearIsa, testing::Values(Isa::baseline, Isa::avx2, Isa::avx512),
                         [](const auto& instance) {
                             return std::string(isa_name(instance.param));
                         });

// MacNeal & Harder's patch test with their numbers: a linear displacement field on any mesh gives
// constant stress, and no force on inner nodes. In the small: the field is scaled down until the
// quadratic part of Green's strain is below rounding of the linear one.
TEST(StvkLinear, PassesThePatchTest) {
    Solid solid;
    solid.young = 1e6;
    solid.poisson = 0.25;
    solid.density = 1;
    const TetMesh mesh = irregular_box({1, 1, 1}, 3, 3, 3);
    const StvkLinear model(mesh, solid);
    Mat3 gradient; // of u, times 1e-3
    gradient << 1, 0.5, 0.5, 0.5, 1, 0.5, 0.5, 0.5, 1;
    NodeArray x(mesh.node.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = mesh.node[i] + 1e-3 * gradient * mesh.node[i];
    // Stress of the finite law for this F, and 2000, 400 Pa of the linear one within 0.3 %.
    const Mat3 f = Mat3::Identity() + 1e-3 * gradient;
    const Mat3 e = 0.5 * (f.transpose() * f - Mat3::Identity());
    const Mat3 s = solid.lambda() * e.trace() * Mat3::Identity() + 2 * solid.mu() * e;
    EXPECT_NEAR(s(0, 0), 2000, 6);
    EXPECT_NEAR(s(0, 1), 400, 1.2);
    const Mat3 p = f * s;
    const NodeArray force = force_of(model, x, NodeArray(x.size()));
    Mat3 virial = Mat3::Zero(); // -sum f (x) X = integral of P: the mean stress of the unit cube
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3& at = mesh.node[i];
        if ((at.array() > 1e-9).all() && (at.array() < 1 - 1e-9).all()) {
            EXPECT_LE(force[i].norm(), 1e-12 * 2000);
        }
        virial -= force[i] * at.transpose();
    }
    EXPECT_LE((virial - p).norm(), 1e-12 * p.norm());
}

TEST(StvkLinear, KeepsSolidsOfGroupsApart) {
    TetMesh mesh = box_mesh({2, 1, 1}, 2, 1, 1);
    for (std::size_t e = 0; e < mesh.element_count(); ++e)
        mesh.group.push_back(e < 6 ? 0 : 1);
    mesh.group_name = {"soft", "stiff"};
    Solid both[2] = {rubber(), rubber()};
    both[1].young *= 10;
    both[1].density *= 3;
    const StvkLinear model(mesh, both);
    double mass = 0;
    for (const double m : model.mass())
        mass += m;
    EXPECT_NEAR(mass, rubber().density * 4, 1e-9);
    // Uniform stretch: ten times the energy density in one half.
    NodeArray x = node_array(mesh.node);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] *= 1.01;
    const double one = stvk_energy(both[0], 1.01 * Mat3::Identity());
    EXPECT_NEAR(model.energy(x), 11 * one, 1e-9 * one);
    EXPECT_THROW(StvkLinear(mesh, rubber()), InputError);
}

TEST(StvkLinear, RefusesWhatItCannotStepAndSaysWhy) {
    TetMesh mesh = box_mesh({1, 1, 1}, 1, 1, 1);
    std::swap(mesh.element[4], mesh.element[5]);
    try {
        StvkLinear(mesh, rubber());
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("element 1"), std::string::npos) << error.what();
    }
    mesh.order = 2;
    EXPECT_THROW(StvkLinear(mesh, rubber()), InputError);
}

} // namespace
} // namespace ode::soft
