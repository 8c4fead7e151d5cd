#include "model/stvk_quadratic.h"

#include "base/error.h"
#include "unit/model/specimens.h"

#include "model/tet10_shape.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

/// Largest force on inner nodes of a unit cube under the linear field of MacNeal & Harder, per
/// stress, and the mean stress off its exact value.
struct Patch {
    double inner, mean;
};

Patch patch_test(const TetMesh& mesh) {
    Solid solid;
    solid.young = 1e6;
    solid.poisson = 0.25;
    solid.density = 1;
    const StvkQuadratic model(mesh, solid);
    Mat3 gradient; // of u, times 1e-3
    gradient << 1, 0.5, 0.5, 0.5, 1, 0.5, 0.5, 0.5, 1;
    const Mat3 f = Mat3::Identity() + 1e-3 * gradient;
    const Mat3 e = 0.5 * (f.transpose() * f - Mat3::Identity());
    const Mat3 p = f * (solid.lambda() * e.trace() * Mat3::Identity() + 2 * solid.mu() * e);
    NodeArray x(mesh.node.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = f * mesh.node[i];
    const NodeArray force = force_of(model, x, NodeArray(x.size()));
    Patch out{0, 0};
    Mat3 virial = Mat3::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3& at = mesh.node[i];
        if ((at.array() > 1e-9).all() && (at.array() < 1 - 1e-9).all())
            out.inner = std::max(out.inner, force[i].norm() / 2000);
        virial -= force[i] * at.transpose();
    }
    out.mean = (virial - p).norm() / p.norm();
    return out;
}

TEST(StvkQuadratic, PassesThePatchTestWithStraightEdges) {
    const Patch patch = patch_test(with_mid_nodes(irregular_box({1, 1, 1}, 3, 3, 3)));
    EXPECT_LE(patch.inner, 1e-12);
    EXPECT_LE(patch.mean, 1e-12);
}

// Over a curved element the gradient of a shape times the Jacobian is cubic, with a cubic part of
// second order in the curvature; the four points integrate degree 2. So curved patches are off by
// the square of the curvature, which is what convergence of quadratic elements needs (Ciarlet &
// Raviart 1972: degree 2k - 2).
TEST(StvkQuadratic, PassesThePatchTestWithCurvedEdgesToSecondOrderOfCurvature) {
    const Patch coarse = patch_test(curved_box({1, 1, 1}, 3, 3, 3, 0.02));
    const Patch fine = patch_test(curved_box({1, 1, 1}, 3, 3, 3, 0.01));
    EXPECT_LE(coarse.inner, 1e-3 / 9); // of the stress on a cell's face
    EXPECT_NEAR(coarse.inner / fine.inner, 4, 1);
}

// A straight element's integrals in closed form: corners V/70, edges 8 V/105, and so on.
TEST(StvkQuadratic, MassOfAStraightElementIsTheClosedForm) {
    TetMesh one;
    one.node = {{0, 0, 0}, {0.3, 0, 0.1}, {0.1, 0.2, 0}, {0, 0.1, 0.4}};
    one.element = {0, 1, 2, 3};
    Solid solid = rubber();
    const TetMesh mesh = with_mid_nodes(one);
    const StvkQuadratic model(mesh, solid);
    Mat3 edges;
    edges << one.node[1], one.node[2], one.node[3];
    const double mass = solid.density * edges.determinant() / 6;
    const Eigen::SparseMatrix<double> m = model.consistent_mass();
    EXPECT_NEAR(m.coeff(0, 0), mass * 6 / 420, 1e-14 * mass);
    EXPECT_NEAR(m.coeff(0, 3), mass * 1 / 420, 1e-14 * mass);
    EXPECT_NEAR(m.coeff(12, 12), mass * 32 / 420, 1e-14 * mass);
    EXPECT_NEAR(m.coeff(0, 12), mass * -4 / 420, 1e-14 * mass);  // corner, its edge
    EXPECT_NEAR(m.coeff(0, 15), mass * -6 / 420, 1e-14 * mass);  // corner, opposite edge
    EXPECT_NEAR(m.coeff(12, 15), mass * 16 / 420, 1e-14 * mass); // edges that meet
    EXPECT_NEAR(m.coeff(12, 27), mass * 8 / 420, 1e-14 * mass);  // edges that do not
    EXPECT_NEAR(model.mass()[0], mass / 36, 1e-14 * mass);
    EXPECT_NEAR(model.mass()[4], mass * 4 / 27, 1e-14 * mass);
}

// A quadratic displacement is reproduced: pure bending u = (xz, 0, -x^2/2) of a strip without
// lateral contraction stores E/2 integral of z^2, to the square of the amplitude.
TEST(StvkQuadratic, BendsWithoutLocking) {
    Solid solid = rubber();
    solid.poisson = 0;
    const double length = 0.3, width = 0.05, thick = 0.02, curvature = 1e-6;
    const TetMesh mesh = with_mid_nodes(box_mesh({length, width, thick}, 4, 1, 1));
    const StvkQuadratic model(mesh, solid);
    NodeArray x(mesh.node.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3& at = mesh.node[i];
        const double z = at.z() - thick / 2;
        x[i] = at + curvature * Vec3(at.x() * z, 0, -at.x() * at.x() / 2);
    }
    const double moment = width * thick * thick * thick / 12;
    const double exact = solid.young / 2 * moment * curvature * curvature * length;
    EXPECT_NEAR(model.energy(x), exact, 1e-5 * exact);
}

TEST(StvkQuadratic, RefusesFoldedElementsAndLinearMeshes) {
    TetMesh mesh = with_mid_nodes(box_mesh({1, 1, 1}, 1, 1, 1));
    EXPECT_THROW(StvkQuadratic(box_mesh({1, 1, 1}, 1, 1, 1), rubber()), InputError);
    const int mid = mesh.element[14];
    mesh.node[static_cast<std::size_t>(mid)] += Vec3(0.6, -0.4, 0.5);
    try {
        StvkQuadratic(mesh, rubber());
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("folds over"), std::string::npos);
    }
}

// Integrals of L0^a L1^b over the element, relative to its volume: 6 a! b! / (a + b + 3)!.
TEST(TetRule, IsExactToDegreeFive) {
    const double factorial[] = {1, 1, 2, 6, 24, 120, 720, 5040, 40320};
    for (int a = 0; a <= 5; ++a)
        for (int b = 0; a + b <= 5; ++b) {
            double sum = 0;
            for (const TetPoint& p : tet_rule_of_degree_5())
                sum += p.weight * std::pow(p.l[0], a) * std::pow(p.l[1], b);
            EXPECT_NEAR(sum, 6 * factorial[a] * factorial[b] / factorial[a + b + 3], 1e-15);
        }
}

} // namespace
} // namespace ode::soft
