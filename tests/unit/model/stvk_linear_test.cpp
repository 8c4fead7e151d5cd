#include "model/stvk_linear.h"

#include "base/error.h"
#include "unit/model/specimens.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

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
    const double one = StvkLaw::energy(both[0], 1.01 * Mat3::Identity());
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
