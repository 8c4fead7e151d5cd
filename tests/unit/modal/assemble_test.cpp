#include "modal/assemble.h"

#include "base/error.h"
#include "mesh/generate.h"
#include "modal/rigid_motion.h"
#include "support/quadratic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ode::soft {
namespace {

const Solid kSteel{.young = 200e9, .poisson = 0.29, .density = 7850};

/// A box sheared out of square, so that nothing is right by symmetry.
TetMesh sheared_box() {
    TetMesh mesh = make_box({0.3, 0.2, 0.1}, 3, 2, 2);
    for (Vec3& x : mesh.node)
        x += Vec3(0.2 * x.y() + 0.1 * x.z(), 0.15 * x.z(), 0.05 * x.x());
    return mesh;
}

RowMatrix sample(const BlockSystem& s, const std::function<Vec3(const Vec3&)>& field) {
    RowMatrix u(s.size(), 1);
    for (std::size_t i = 0; i < s.node_count(); ++i)
        u.middleRows(3 * static_cast<Eigen::Index>(i), 3) = field(s.position[i]);
    return u;
}

class Assembly : public testing::TestWithParam<std::tuple<int, bool>> {
protected:
    int order() const { return std::get<0>(GetParam()); }
    /// Straight, or with every mid-edge node pushed off its edge; straight quadratic for order 1.
    TetMesh mesh() const {
        return std::get<1>(GetParam()) && order() > 1 ? bent(to_quadratic(sheared_box()), 0.004)
               : std::get<1>(GetParam())              ? to_quadratic(sheared_box())
                                                      : sheared_box();
    }
    BlockSystem system(const Solid& solid = kSteel, MassKind mass = MassKind::kConsistent) const {
        const TetMesh m = mesh();
        return assemble(m, number_nodes(m, order()), std::span(&solid, 1), mass);
    }
};
INSTANTIATE_TEST_SUITE_P(OrdersStraightAndCurved, Assembly,
                         testing::Combine(testing::Values(1, 2, 3, 4), testing::Bool()));

TEST_P(Assembly, StiffnessAndMassAreSymmetricToTheLastBit) {
    const BlockSystem s = system();
    for (std::size_t i = 0; i < s.node_count(); ++i)
        for (int p = s.start[i]; p < s.start[i + 1]; ++p) {
            const auto ij = static_cast<std::size_t>(p);
            const auto j = static_cast<std::size_t>(s.column[ij]);
            int q = s.start[j];
            while (s.column[static_cast<std::size_t>(q)] != static_cast<int>(i))
                ++q;
            const auto ji = static_cast<std::size_t>(q);
            EXPECT_EQ(s.mass[ij], s.mass[ji]);
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t c = 0; c < 3; ++c)
                    EXPECT_EQ(s.stiffness[9 * ij + 3 * r + c], s.stiffness[9 * ji + 3 * c + r]);
        }
}

// On curved geometry too: displacement and position share the corners' coordinates, and a rigid
// motion is a linear function of position, which orders 2 and 3 hold on quadratic geometry.
TEST_P(Assembly, RigidMotionsHaveNoForce) {
    const BlockSystem s = system();
    const RowMatrix rigid = free_rigid_motions(s, std::vector<char>(s.node_count(), 0));
    ASSERT_EQ(rigid.cols(), 6);
    RowMatrix force;
    multiply_stiffness(s, rigid, force);
    const double scale = *std::max_element(s.stiffness.begin(), s.stiffness.end());
    EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-13 * scale * rigid.cwiseAbs().maxCoeff());
}

// Sum of all entries of M in one direction: the mass; and the mass is density times volume.
TEST_P(Assembly, MassAddsUp) {
    const TetMesh m = mesh();
    const double mass = mass_properties(m, std::span(&kSteel, 1)).mass;
    for (const MassKind kind : {MassKind::kConsistent, MassKind::kLumped}) {
        const BlockSystem s = system(kSteel, kind);
        double sum = 0;
        for (const double v : s.mass)
            sum += v;
        EXPECT_NEAR(sum, mass, 1e-12 * mass);
    }
}

TEST_P(Assembly, LumpedMassIsDiagonalAndPositive) {
    const BlockSystem s = system(kSteel, MassKind::kLumped);
    for (std::size_t i = 0; i < s.node_count(); ++i)
        for (int p = s.start[i]; p < s.start[i + 1]; ++p)
            if (s.column[static_cast<std::size_t>(p)] == static_cast<int>(i))
                EXPECT_GT(s.mass[static_cast<std::size_t>(p)], 0);
            else
                EXPECT_EQ(s.mass[static_cast<std::size_t>(p)], 0);
}

// Uniform strain must be in equilibrium at every inner node: the patch test (Irons).
TEST_P(Assembly, PassesThePatchTest) {
    const TetMesh m = mesh();
    const DofMap map = number_nodes(m, order());
    const BlockSystem s = system();
    Mat3 gradient;
    gradient << 1, 0.3, -0.2, 0.5, -0.7, 0.1, 0.4, 0.2, 0.6;
    const RowMatrix u = sample(s, [&](const Vec3& x) -> Vec3 { return 1e-3 * gradient * x; });
    RowMatrix force;
    multiply_stiffness(s, u, force);
    const std::vector<char> outer = boundary_nodes(map);
    int inner = 0;
    for (std::size_t i = 0; i < s.node_count(); ++i)
        if (!outer[i]) {
            ++inner;
            EXPECT_LT(force.middleRows(3 * static_cast<Eigen::Index>(i), 3).norm(),
                      1e-12 * force.norm());
        }
    EXPECT_GT(inner, 0);
}

// u = (c x^p, 0, 0) on a straight box: energy density (lambda + 2 mu)/2 (c p x^(p-1))^2.
TEST(Assembly, EnergyOfAPolynomialFieldIsExact) {
    const TetMesh mesh = make_box({2, 1, 1}, 2, 1, 1); // x from -1 to 1
    for (int p = 1; p <= 3; ++p) {
        const BlockSystem s = assemble(mesh, number_nodes(mesh, p), std::span(&kSteel, 1));
        const RowMatrix u =
            sample(s, [&](const Vec3& x) { return Vec3(std::pow(x.x(), p), 0, 0); });
        RowMatrix force;
        multiply_stiffness(s, u, force);
        const double exact = 0.5 * (kSteel.lambda() + 2 * kSteel.mu()) * p * p * 2.0 / (2 * p - 1);
        EXPECT_NEAR(0.5 * u.col(0).dot(force.col(0)), exact, 1e-12 * exact) << p;
        RowMatrix momentum;
        multiply_mass(s, u, momentum);
        const double kinetic = kSteel.density * 2.0 / (2 * p + 1);
        EXPECT_NEAR(u.col(0).dot(momentum.col(0)), kinetic, 1e-12 * kinetic) << p;
    }
}

TEST(MassProperties, OfABoxAgreeWithTheClosedForm) {
    TetMesh mesh = make_box({0.3, 0.2, 0.1}, 2, 3, 1);
    for (Vec3& x : mesh.node)
        x += Vec3(5, -3, 2); // far from the origin: no cancellation allowed
    const MassProperties p = mass_properties(mesh, std::span(&kSteel, 1));
    const double m = 7850 * 0.006;
    EXPECT_NEAR(p.volume, 0.006, 1e-15);
    EXPECT_NEAR(p.mass, m, 1e-12);
    EXPECT_LT((p.centre - Vec3(5, -3, 2)).norm(), 1e-13);
    const Vec3 inertia = m / 12 * Vec3(0.04 + 0.01, 0.09 + 0.01, 0.09 + 0.04);
    EXPECT_LT((p.inertia - Mat3(inertia.asDiagonal())).norm(), 1e-12 * inertia.norm());
}

TEST(CheckSolids, RefusesNonsenseInOneSentence) {
    const TetMesh mesh = make_box({1, 1, 1}, 1, 1, 1);
    const auto refused = [&](Solid s, const char* what) {
        EXPECT_THAT([&] { check_solids(mesh, std::span(&s, 1)); },
                    testing::ThrowsMessage<InputError>(testing::HasSubstr(what)));
    };
    refused({.young = 0, .poisson = 0.3, .density = 1000}, "Young's modulus is 0 Pa");
    refused({.young = 1e9, .poisson = 0.5, .density = 1000}, "Poisson's ratio is 0.5");
    refused({.young = 1e9, .poisson = -1, .density = 1000}, "Poisson's ratio is -1");
    refused({.young = 1e9, .poisson = 0.3, .density = 0}, "density is 0 kg/m^3");
    refused({.young = std::nan(""), .poisson = 0.3, .density = 1}, "Young's modulus");
    TetMesh two = mesh;
    two.group.assign(two.element_count(), 0);
    two.group.back() = 1;
    EXPECT_THAT([&] { check_solids(two, std::span(&kSteel, 1)); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("2 groups")));
}

TEST(Assemble, NamesAnInvertedElement) {
    TetMesh mesh = make_box({1, 1, 1}, 1, 1, 1);
    std::swap(mesh.element[4 * 2], mesh.element[4 * 2 + 1]);
    EXPECT_THAT([&] { assemble(mesh, number_nodes(mesh, 2), std::span(&kSteel, 1)); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("element 2 is inverted")));
}

} // namespace
} // namespace ode::soft
