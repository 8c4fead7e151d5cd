#include "couple/surface_elasticity.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <numbers>

namespace ode::soft {
namespace {

constexpr double kLeastCurvature = 0.1; ///< of the gap across, in that along
constexpr double kDeepest = 0.25;       ///< in radii: Hertz's parabola is no ball further up
constexpr int kSweeps = 40;
constexpr double kConverged = 1e-3;

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

/// Displacement of a half-space at x from a unit force at the origin of its face, along p into it.
Vec3 boussinesq(const Vec3& x, const Vec3& p, const Solid& solid) {
    const double nu = solid.poisson;
    const double r = x.norm();
    const double z = std::fmax(0.0, x.dot(p)); // a curved surface's nodes may lie before the face
    const Vec3 across = x - x.dot(p) * p;
    const double r3 = r * r * r;
    return (1 + nu) / (2 * std::numbers::pi * solid.young) *
           ((z * z / r3 + 2 * (1 - nu) / r) * p + (z / r3 - (1 - 2 * nu) / (r * (r + z))) * across);
}

/// Yielding of one node on a patch: itself and its neighbours free, the rest in the far field.
class Patch {
public:
    Patch(const TetMesh& mesh, const ElasticModel& model)
        : mesh_(mesh), displacement_(mesh.node.size()), start_(mesh.node.size() + 1, 0) {
        NodeArray rest(mesh.node.size());
        for (std::size_t i = 0; i < rest.size(); ++i)
            rest[i] = mesh.node[i];
        const Eigen::SparseMatrix<double> k = model.stiffness(rest);
        for (std::size_t n = 0; n < rest.size(); ++n) {
            Mat3 own = Mat3::Zero();
            for (int c = 0; c < 3; ++c) { // symmetric: columns are rows
                std::size_t at = start_[n];
                for (Eigen::SparseMatrix<double>::InnerIterator it(k, 3 * static_cast<int>(n) + c);
                     it; ++it) {
                    const int other = static_cast<int>(it.row() / 3);
                    const auto d = it.row() % 3;
                    if (other == static_cast<int>(n)) {
                        own(c, d) = it.value();
                        continue;
                    }
                    while (at < link_.size() && link_[at].node != other)
                        ++at;
                    if (at == link_.size())
                        link_.push_back({other, Mat3::Zero()});
                    link_[at].stiffness(c, d) = it.value();
                }
            }
            yielding_.push_back(own.inverse());
            start_[n + 1] = link_.size();
        }
    }

    double compliance(int node, const Vec3& inward, const Solid& solid) {
        const std::span<const Link> around = links(node);
        double near = std::numeric_limits<double>::infinity();
        for (const Link& link : around) {
            near = std::fmin(near, (mesh_.node[index(link.node)] - mesh_.node[index(node)]).norm());
            displacement_[index(link.node)] = field(link.node, node, inward, solid);
            for (const Link& far : links(link.node))
                if (far.node != node)
                    displacement_[index(far.node)] = field(far.node, node, inward, solid);
        }
        displacement_[index(node)] = boussinesq(near / 2 * inward.unitOrthogonal(), inward, solid);
        double now = 0;
        for (int sweep = 0; sweep < kSweeps; ++sweep) { // by blocks of Gauss and Seidel
            const double before = now;
            relax(node, inward);
            for (const Link& link : around)
                relax(link.node, Vec3::Zero());
            now = inward.dot(displacement_[index(node)]);
            if (std::fabs(now - before) < kConverged * std::fabs(now))
                break;
        }
        return now;
    }

private:
    struct Link {
        int node;
        Mat3 stiffness;
    };

    std::span<const Link> links(int node) const {
        return std::span(link_).subspan(start_[index(node)],
                                        start_[index(node) + 1] - start_[index(node)]);
    }
    Vec3 field(int at, int loaded, const Vec3& inward, const Solid& solid) const {
        return boussinesq(mesh_.node[index(at)] - mesh_.node[index(loaded)], inward, solid);
    }
    void relax(int node, Vec3 force) {
        for (const Link& link : links(node))
            force -= link.stiffness * displacement_[index(link.node)];
        displacement_[index(node)] = yielding_[index(node)] * force;
    }

    const TetMesh& mesh_;
    NodeArray displacement_;
    std::vector<Mat3> yielding_;     ///< of each node alone [m/N]
    std::vector<std::size_t> start_; ///< per node, into link_
    std::vector<Link> link_;
};

} // namespace

PointElasticity measure_elasticity(const TetMesh& mesh, const SurfaceNodes& surface,
                                   const ElasticModel& model, std::span<const Solid> solids) {
    std::vector<const Solid*> softest(mesh.node.size(), nullptr);
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const Solid& solid = solids[solids.size() == 1 ? 0 : index(mesh.group[e])];
        for (const int n : mesh.nodes_of(e)) {
            const Solid*& here = softest[index(n)];
            if (!here || solid.young < here->young)
                here = &solid;
        }
    }
    PointElasticity out;
    out.place.assign(mesh.node.size(), -1);
    Patch patch(mesh, model);
    for (std::size_t i = 0; i < surface.node.size(); ++i) {
        const int node = surface.node[i];
        const Solid& solid = *softest[index(node)];
        out.place[index(node)] = static_cast<int>(i);
        out.modulus.push_back(solid.young / (1 - solid.poisson * solid.poisson));
        out.relaxation.push_back(solid.beta);
        out.compliance.push_back(patch.compliance(node, -surface.shape.normal[i], solid));
    }
    return out;
}

std::array<double, 3> corner_coupling(const SurfaceNodes& surface, int triangle) noexcept {
    const PointElasticity& elastic = surface.elastic;
    const auto& corner = surface.triangle[index(triangle)];
    const auto& side = surface.side[index(triangle)];
    std::array<double, 3> out{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double a = elastic.modulus[index(elastic.place[index(corner[(i + 1) % 3])])];
        const double b = elastic.modulus[index(elastic.place[index(corner[(i + 2) % 3])])];
        out[i] = 2 / (std::numbers::pi * (a + b) * side[i]);
    }
    return out;
}

HertzSpring point_spring(const SurfaceNodes& surface, int triangle, const Vec3& w, double curvature,
                         double rigid_compliance) noexcept {
    const PointElasticity& elastic = surface.elastic;
    const auto& corner = surface.triangle[index(triangle)];
    double modulus = 0;
    double larger = curvature;
    double smaller = curvature;
    double compliance = 0;
    for (int i = 0; i < 3; ++i) {
        const std::size_t a = index(elastic.place[index(corner[index(i)])]);
        modulus += w[i] * elastic.modulus[a];
        larger += w[i] * surface.shape.curvature[a][0];
        smaller += w[i] * surface.shape.curvature[a][1];
        compliance += w[i] * w[i] * elastic.compliance[a];
    }
    const std::array<double, 3> coupling = corner_coupling(surface, triangle);
    for (int i = 0; i < 3; ++i)
        compliance += 2 * w[(i + 1) % 3] * w[(i + 2) % 3] * coupling[index(i)];
    compliance -= surface.residual_at(triangle, w);
    // In a hollow a ball has to fit; two lines would meet in a line.
    smaller = std::fmax(smaller, kLeastCurvature * std::fmax(curvature, larger));
    larger = std::fmax(larger, smaller);
    return {hertz_stiffness(1 / (1 / modulus + rigid_compliance), larger, smaller), compliance,
            kDeepest / larger};
}

} // namespace ode::soft
