#include "mesh/curve.h"

#include "base/error.h"
#include "mesh/jacobian.h"
#include "mesh/promote.h"
#include "mesh/quality.h"
#include "mesh/refine.h"
#include "mesh/surface.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace ode::soft {
namespace {

using std::numbers::pi;

struct Curved {
    const char* name;
    std::function<TetMesh(int)> make; // element size proportional to 1 / argument
    double volume;
};

const std::vector<Curved>& curved_shapes() {
    static const std::vector<Curved> shapes = {
        {"sphere", [](int n) { return make_sphere(1.0, 3 * n); }, 4.0 * pi / 3.0},
        {"bowl", [](int n) { return make_bowl(0.1, 0.005, pi / 2.0, 8 * n, 48 * n, 1); },
         2.0 * pi / 3.0 * (1e-3 - std::pow(0.095, 3))},
        {"tube", [](int n) { return make_tube(1.0, 0.2, 0.1, 8 * n, 16 * n, n); }, pi * 0.03},
        {"ring", [](int n) { return make_tube(0.1, 0.2, 0.19, 2 * n, 24 * n, 1); },
         pi * 0.1 * (0.04 - 0.0361)}};
    return shapes;
}

// Facets err by the square of their size, parabolic arcs over them by its fourth power: the error
// drops by orders and falls sixteenfold when the size is halved.
TEST(CurveSurface, VolumesConvergeAtFourthOrder) {
    for (const Curved& c : curved_shapes()) {
        double error[2];
        for (int n : {1, 2}) {
            const TetMesh straight = c.make(n);
            TetMesh mesh = promote_to_quadratic(straight);
            const CurveReport report = curve_surface(mesh);
            EXPECT_EQ(report.limited, 0U) << c.name;
            EXPECT_EQ(report.doubtful, 0U) << c.name;
            EXPECT_NO_THROW(check_mesh(mesh, c.name));
            error[n - 1] = std::abs(measure_quality(mesh).volume - c.volume);
            EXPECT_LT(error[n - 1], 0.02 * std::abs(measure_quality(straight).volume - c.volume))
                << c.name;
        }
        // On the rims of the ring the other end is mirrored, which takes finer meshes to settle.
        EXPECT_NEAR(std::log2(error[0] / error[1]), 4.0, 0.4) << c.name;
    }
}

// Vertex normals after Max are exact on a sphere and the sagitta is that of the circle, so that
// every surface node lies on it, to the conditioning of an angle of order 0.1: some 10 eps.
TEST(CurveSurface, PutsTheNodesOfASphereOnIt) {
    TetMesh mesh = promote_to_quadratic(make_sphere(1.0, 4));
    curve_surface(mesh);
    for (const int n : extract_surface(mesh).node)
        EXPECT_NEAR(mesh.node[static_cast<std::size_t>(n)].norm(), 1.0, 1e-13);
}

// Three-point tangents are exact on circles: the rims of a tube are circles again.
TEST(CurveSurface, PutsTheRimsOfATubeOnTheirCircles) {
    TetMesh mesh = promote_to_quadratic(make_tube(1.0, 0.2, 0.1, 4, 16, 1));
    curve_surface(mesh);
    int on_rims = 0;
    for (const Vec3& x : mesh.node) {
        const double r = std::hypot(x[0], x[1]);
        if (x[2] == 0.0 && (r < 0.11 || r > 0.19)) {
            EXPECT_NEAR(r, r < 0.15 ? 0.1 : 0.2, 1e-15);
            ++on_rims;
        }
    }
    EXPECT_EQ(on_rims, 64); // 16 corners and 16 middles each
}

TEST(CurveSurface, LeavesFlatBodiesToTheBit) {
    const TetMesh shapes[] = {make_box({1.0, 2.0, 3.0}, 3, 4, 5),
                              make_bar(0.3, 0.02, 0.01, 30, 2, 1),
                              make_plate(0.4, 0.3, 0.01, 5, 4, 1)};
    // Turned, so that the normals are not exact in binary.
    const Mat3 turn = Quat(0.3, 0.5, -0.4, 0.2).normalized().toRotationMatrix();
    for (const TetMesh& shape : shapes) {
        TetMesh linear = shape;
        for (Vec3& x : linear.node)
            x = turn * x + Vec3(0.1, 0.7, -0.3);
        TetMesh mesh = promote_to_quadratic(linear);
        const std::vector<Vec3> before = mesh.node;
        EXPECT_EQ(curve_surface(mesh).moved, 0U);
        EXPECT_EQ(mesh.node, before);
    }
}

// Only what lies on the surface between corners may move.
TEST(CurveSurface, KeepsCornersAndInnerNodes) {
    const TetMesh linear = make_bowl(0.1, 0.02, pi / 2.0, 4, 24, 2);
    TetMesh mesh = promote_to_quadratic(linear);
    const TetMesh straight = mesh;
    curve_surface(mesh);
    std::vector<bool> outer(mesh.node.size());
    for (const int n : extract_surface(mesh).node)
        outer[static_cast<std::size_t>(n)] = true;
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
        if (i < linear.node.size() || !outer[i]) {
            EXPECT_EQ(mesh.node[i], straight.node[i]);
        }
}

// det J sampled independently of the Bernstein bound that the guard uses: at the points of a grid.
double least_jacobian_on_grid(const TetMesh& mesh, std::size_t e) {
    const auto n = mesh.nodes_of(e);
    const auto x = [&](int i) -> const Vec3& {
        return mesh.node[static_cast<std::size_t>(n[static_cast<std::size_t>(i)])];
    };
    const double straight = (x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0));
    double least = 1e300;
    constexpr int kSteps = 6;
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j)
            for (int k = 0; i + j + k <= kSteps; ++k) {
                const double l[4] = {double(kSteps - i - j - k) / kSteps, double(i) / kSteps,
                                     double(j) / kSteps, double(k) / kSteps};
                Vec3 slope[4]; // dx/dl_a with the shape functions l (2 l - 1) and 4 l_a l_b
                for (int a = 0; a < 4; ++a) {
                    slope[a] = (4.0 * l[a] - 1.0) * x(a);
                    for (int b = 0; b < 4; ++b)
                        if (b != a)
                            slope[a] += 4.0 * l[b] * x(kTetMid[a][b]);
                }
                const double det =
                    (slope[1] - slope[0]).cross(slope[2] - slope[0]).dot(slope[3] - slope[0]);
                least = std::min(least, det / straight);
            }
    return least;
}

// A thin wall of few facets: parabolas would cut through the inner wall, the guard keeps every
// element one-to-one with the Jacobian asked for.
TEST(CurveSurface, GuardKeepsTheJacobianOfCoarseThinWalls) {
    std::size_t limited = 0;
    for (const TetMesh& linear :
         {make_tube(0.2, 0.1, 0.098, 1, 10, 1), make_bowl(0.1, 0.001, pi / 2.0, 3, 12, 1)}) {
        TetMesh mesh = promote_to_quadratic(linear);
        const CurveReport report = curve_surface(mesh);
        EXPECT_GT(report.moved, 0U);
        limited += report.limited;
        for (std::size_t e = 0; e < mesh.element_count(); ++e) {
            EXPECT_GE(relative_jacobian(mesh, e), 0.15);
            EXPECT_GE(least_jacobian_on_grid(mesh, e), 0.15);
        }
    }
    EXPECT_GT(limited, 0U);
}

// Eight facets round meet at 45 degrees: told, whatever is made of it.
TEST(CurveSurface, TellsOfFewFacetsRound) {
    TetMesh mesh = promote_to_quadratic(make_tube(1.0, 0.2, 0.1, 4, 8, 1));
    EXPECT_EQ(curve_surface(mesh).doubtful, 64U); // 8 lines of 4 edges on two walls
}

TEST(CurveSurface, RefusesLinearElements) {
    TetMesh mesh = make_box({1, 1, 1}, 1, 1, 1);
    EXPECT_THROW(curve_surface(mesh), InputError);
}

// Refined at its curved edges a body approaches the round one at second order, where refining its
// facets would leave the error as it is.
TEST(Refine, OfACurvedMeshApproachesTheRoundBody) {
    for (const Curved& c : curved_shapes()) {
        const TetMesh facets = c.make(1);
        TetMesh mesh = promote_to_quadratic(facets);
        curve_surface(mesh);
        const TetMesh fine = refine_uniformly(mesh);
        EXPECT_NO_THROW(check_mesh(fine, c.name));
        const double before = std::abs(measure_quality(facets).volume - c.volume);
        const double after = std::abs(measure_quality(fine).volume - c.volume);
        EXPECT_NEAR(before / after, 4.0, 0.4) << c.name;
    }
}

} // namespace
} // namespace ode::soft
