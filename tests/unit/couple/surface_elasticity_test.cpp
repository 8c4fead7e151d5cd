#include "couple/surface_elasticity.h"

#include "mesh/generate.h"
#include "model/make_model.h"

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace ode::soft {
namespace {

Solid solid() {
    Solid s;
    s.young = 1;
    s.poisson = 0.3;
    s.density = 1;
    return s;
}

struct Measured {
    explicit Measured(TetMesh given) : mesh(std::move(given)), surface(extract_surface(mesh)) {
        const Solid s = solid();
        model = make_model("stvk", mesh, {&s, 1});
        nodes = SurfaceNodes(mesh, surface, model->mass());
        nodes.elastic = measure_elasticity(mesh, nodes, *model, {&s, 1});
    }

    TetMesh mesh;
    Surface surface;
    std::unique_ptr<ElasticModel> model;
    SurfaceNodes nodes;
};

/// Displacement under a unit normal load on a node of a box's top, all else of the box free but its
/// far sides, which are held where a half-space's would be (Johnson 1985, 3.2).
double yielding_of_a_half_space(const Measured& m, int node, double half) {
    const Vec3 load = m.mesh.node[static_cast<std::size_t>(node)];
    const auto far_field = [&](const Vec3& at) -> Vec3 {
        const Vec3 x = at - load;
        const double r = x.norm();
        const double depth = -x.z();
        const double c = 1.3 / (2 * M_PI);
        return c * ((depth * depth / (r * r * r) + 1.4 / r) * -Vec3::UnitZ() +
                    (depth / (r * r * r) - 0.4 / (r * (r + depth))) * Vec3(x.x(), x.y(), 0));
    };
    NodeArray rest(m.mesh.node.size());
    for (std::size_t i = 0; i < rest.size(); ++i)
        rest[i] = m.mesh.node[i];
    const Eigen::SparseMatrix<double> k = m.model->stiffness(rest);
    std::vector<int> place(static_cast<std::size_t>(k.rows()), -1);
    int free = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const Vec3& x = m.mesh.node[i];
        const bool far = std::fabs(std::fabs(x.x()) - half) < 1e-9 ||
                         std::fabs(std::fabs(x.y()) - half) < 1e-9 || x.z() < -half + 1e-9;
        for (std::size_t c = 0; !far && c < 3; ++c)
            place[3 * i + c] = free++;
    }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(free);
    for (int c = 0; c < k.cols(); ++c)
        for (Eigen::SparseMatrix<double>::InnerIterator it(k, c); it; ++it) {
            const int row = place[static_cast<std::size_t>(it.row())];
            const int column = place[static_cast<std::size_t>(c)];
            if (row >= 0 && column >= 0)
                entries.emplace_back(row, column, it.value());
            else if (row >= 0)
                force[row] -=
                    it.value() * far_field(m.mesh.node[static_cast<std::size_t>(c / 3)])[c % 3];
        }
    const int loaded = place[static_cast<std::size_t>(3 * node + 2)];
    force[loaded] -= 1;
    Eigen::SparseMatrix<double> a(free, free);
    a.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(a);
    return -solver.solve(force)[loaded];
}

TEST(SurfaceElasticity, YieldsAsTheMeshOfAHalfSpace) {
    const Measured m(make_box(Vec3(10, 10, 10), 10, 10, 10));
    int seen = 0;
    for (std::size_t i = 0; i < m.nodes.node.size(); ++i) {
        const int node = m.nodes.node[i];
        const Vec3& x = m.mesh.node[static_cast<std::size_t>(node)];
        if (!(x.z() > 4.9 && x.head<2>().cwiseAbs().maxCoeff() < 1.1))
            continue;
        const double exact = yielding_of_a_half_space(m, node, 5);
        if (seen++ % 4 == 0)
            std::printf("C E h = %.4f, whole box %.4f\n", m.nodes.elastic.compliance[i], exact);
        EXPECT_NEAR(m.nodes.elastic.compliance[i], exact, 0.02 * exact);
    }
    EXPECT_EQ(seen, 9);
}

TEST(SurfaceElasticity, SeesABallsCurvatureExactly) {
    const double radius = 0.05;
    const Measured m(make_sphere(radius, 3));
    for (std::size_t i = 0; i < m.nodes.node.size(); ++i) {
        EXPECT_NEAR(m.nodes.shape.curvature[i][0], 1 / radius, 1e-9 / radius);
        EXPECT_NEAR(m.nodes.shape.curvature[i][1], 1 / radius, 1e-9 / radius);
    }
    for (std::size_t t = 0; t < m.nodes.triangle.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const double e = m.nodes.side[t][i];
            EXPECT_NEAR(m.nodes.shape.bulge[t][i], e * e / (2 * radius), 1e-9 * radius);
        }
}

TEST(SurfaceElasticity, SeesNoCurvatureInABox) {
    const Measured m(make_box(Vec3(1, 1, 1), 3, 3, 3));
    for (std::size_t i = 0; i < m.nodes.node.size(); ++i) {
        EXPECT_NEAR(m.nodes.shape.curvature[i][0], 0, 1e-12);
        EXPECT_FALSE(m.nodes.shape.bulges(i));
    }
}

} // namespace
} // namespace ode::soft
