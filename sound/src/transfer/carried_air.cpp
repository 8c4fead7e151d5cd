#include "transfer/carried_air.h"

#include "transfer/coarsen.h"
#include "transfer/helmholtz.h"

#include <cmath>

namespace ode::sound {
namespace {

/// Area vectors of the nodes.
std::vector<Vec3> node_areas(const BoundaryMesh& mesh) {
    std::vector<Vec3> area(mesh.node.size(), Vec3::Zero());
    const std::vector<Facet> facets = mesh.facets();
    for (std::size_t t = 0; t < facets.size(); ++t)
        for (const int i : mesh.triangle[t])
            area[static_cast<std::size_t>(i)] += facets[t].area / 3.0 * facets[t].normal;
    return area;
}

} // namespace

CarriedAir carried_air(const BoundaryMesh& mesh, std::size_t triangles) {
    CarriedAir air;
    if (mesh.triangle.empty() || !is_closed(mesh))
        return air;
    const Coarsened coarse = coarsen(mesh, triangles);
    const HelmholtzProblem problem(coarse.mesh);
    const auto rows = 3 * static_cast<Eigen::Index>(problem.facets().size());
    Eigen::MatrixXcd slope(rows, 4); // along x, y, z, and outward everywhere
    for (Eigen::Index r = 0; r < rows; ++r) {
        const Facet& f = problem.facets()[static_cast<std::size_t>(r / 3)];
        slope.row(r) << f.normal[0], f.normal[1], f.normal[2], 1.0;
    }
    const Eigen::MatrixXd potential = problem.solve(0.0, slope).real();
    if (!potential.allFinite())
        return air;

    // A node that was taken away gets the value of the nearest on its own side of the body.
    const std::vector<Vec3> area = node_areas(mesh);
    double total = 0.0;
    air.shift.resize(mesh.node.size());
    for (std::size_t i = 0; i < mesh.node.size(); ++i) {
        std::size_t best = 0;
        double least = HUGE_VAL;
        for (std::size_t c = 0; c < coarse.kept.size(); ++c) {
            const auto kept = static_cast<std::size_t>(coarse.kept[c]);
            const double distance = (mesh.node[kept] - mesh.node[i]).squaredNorm();
            const bool across = area[kept].dot(area[i]) < 0.0;
            if (const double d = across ? 1e6 * distance + 1e-300 : distance; d < least) {
                least = d;
                best = c;
            }
        }
        const auto row = static_cast<Eigen::Index>(best);
        air.shift[i] = -potential.row(row).head<3>().transpose();
        const double weight = area[i].norm();
        total += weight;
        air.pulse_length -= weight * potential(row, 3);
        air.shake_length += weight * air.shift[i].squaredNorm();
    }
    air.pulse_length = std::max(air.pulse_length / total, 0.0);
    air.shake_length = std::sqrt(air.shake_length / total);
    if (!(air.shake_length > 0.0) || !std::isfinite(air.shake_length))
        return {};
    return air;
}

} // namespace ode::sound
