#include "couple/surface_shape.h"

#include "couple/surface_nodes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

// Facets that meet at a larger angle are meant to: an icosahedron's, the coarsest ball there is,
// meet at 42 degrees.
constexpr double kSharp = std::numbers::pi / 3;

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

/// The surface round a node.
struct Ring {
    Vec3 normal =
        Vec3::Zero(); ///< exact on spheres: N. Max 1999, doi:10.1080/10867651.1999.10487501
    bool sharp = false;
    std::vector<Vec3> edge; ///< to the neighbours
};

Ring look_round(const TetMesh& mesh, const SurfaceNodes& surface, int node) {
    Ring ring;
    std::vector<Vec3> facet;
    for (const int t : surface.fan(node)) {
        const auto& c = surface.triangle[index(t)];
        const auto at = index(static_cast<int>(std::find(c.begin(), c.end(), node) - c.begin()));
        const Vec3 u = mesh.node[index(c[(at + 1) % 3])] - mesh.node[index(node)];
        const Vec3 v = mesh.node[index(c[(at + 2) % 3])] - mesh.node[index(node)];
        ring.normal += u.cross(v) / (u.squaredNorm() * v.squaredNorm());
        ring.edge.push_back(u);
        facet.push_back(u.cross(v).normalized());
    }
    ring.normal.normalize();
    for (const Vec3& a : facet)
        for (const Vec3& b : facet)
            ring.sharp |= a.dot(b) < std::cos(kSharp);
    return ring;
}

/// Principal curvatures of the paraboloid through the neighbours, in the mean of squares; exact on
/// spheres and cylinders.
std::array<double, 2> curvature_of(const Ring& ring) {
    if (ring.sharp)
        return {0, 0};
    const Vec3 e1 = ring.normal.unitOrthogonal();
    const Vec3 e2 = ring.normal.cross(e1);
    Eigen::MatrixXd a(static_cast<Eigen::Index>(ring.edge.size()), 3);
    Eigen::VectorXd b(a.rows());
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Vec3& e = ring.edge[static_cast<std::size_t>(i)];
        const double x = e.dot(e1);
        const double y = e.dot(e2);
        const double h = e.dot(ring.normal);
        // On a circle of curvature k: 2 h = -k (x^2 + h^2).
        const double stretch = (x * x + y * y + h * h) / (x * x + y * y);
        const double weight = 1 / e.squaredNorm();
        a.row(i) = weight * stretch * Eigen::RowVector3d(x * x, 2 * x * y, y * y);
        b[i] = -2 * weight * h;
    }
    const Eigen::Vector3d k = a.completeOrthogonalDecomposition().solve(b);
    const double mean = (k[0] + k[2]) / 2;
    const double half = std::hypot((k[0] - k[2]) / 2, k[1]);
    return {mean + half, mean - half};
}

} // namespace

SurfaceShape measure_shape(const TetMesh& mesh, const SurfaceNodes& surface) {
    SurfaceShape out;
    std::vector<std::size_t> place(mesh.node.size(), 0);
    for (std::size_t i = 0; i < surface.node.size(); ++i) {
        const Ring ring = look_round(mesh, surface, surface.node[i]);
        place[index(surface.node[i])] = i;
        out.curvature.push_back(curvature_of(ring));
        out.normal.push_back(ring.normal);
    }
    for (const auto& corner : surface.triangle) {
        std::array<double, 3> bulge{};
        for (std::size_t i = 0; i < 3; ++i) {
            const int j = corner[(i + 1) % 3];
            const int k = corner[(i + 2) % 3];
            const std::size_t a = place[index(j)];
            const std::size_t b = place[index(k)];
            if (out.bulges(a) && out.bulges(b)) // e^2 / 2R on a sphere
                bulge[i] = std::fmax(
                    0.0,
                    (out.normal[a] - out.normal[b]).dot(mesh.node[index(j)] - mesh.node[index(k)]) /
                        2);
            out.highest = std::fmax(out.highest, bulge[i] / 3);
        }
        out.bulge.push_back(bulge);
    }
    return out;
}

} // namespace ode::soft
