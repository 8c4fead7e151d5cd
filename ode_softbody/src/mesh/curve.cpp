#include "mesh/curve.h"

#include "base/error.h"
#include "mesh/crease.h"
#include "mesh/jacobian.h"
#include "mesh/topology.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {

namespace {

// Offsets below this share of the edge are rounding of coordinates, not curvature: 1e-6 is the
// sagitta of a circle of 125 000 edge lengths radius.
constexpr double kFlatOffset = 1e-6;
// Where the guard trips an offset shrinks by this factor. Halving would do too, but overshoots:
// nine facets round a thick tube then miss its volume by 4.7 % in place of 1.8 %.
constexpr double kShrink = 0.8;
// After so many times an offset is down to a thousandth; then the edge becomes straight.
constexpr int kMostShrinks = 30;

// Midpoint offset of the circular arc over a chord whose end tangents t0, t1 are unit vectors that
// point along it: with t0 - t1 = 2 sin(phi) b across the chord, (d/2) tan(phi/2) b is
// d/2 (t0 - t1)/2 / (1 + cos(phi)).
Vec3 arc_offset(const Vec3& chord, const Vec3& t0, const Vec3& t1) {
    const double d = chord.norm();
    const Vec3 along = chord / d;
    Vec3 across = 0.5 * (t0 - t1);
    across -= across.dot(along) * along;
    const double cosine = 0.5 * (t0 + t1).dot(along);
    return 0.5 * d / (1.0 + cosine) * across;
}

Vec3 crease_offset(const TetMesh& mesh, const CreasedSurface& surface, const FacetEdge& e) {
    const auto a = static_cast<std::size_t>(e.node[0]), b = static_cast<std::size_t>(e.node[1]);
    const Vec3 chord = mesh.node[b] - mesh.node[a];
    const Vec3 along = chord.normalized();
    const auto tangent = [&](std::size_t node) -> std::optional<Vec3> {
        const auto& t = surface.tangent[node];
        if (!t)
            return {};
        return t->dot(along) < 0.0 ? Vec3(-*t) : *t;
    };
    const auto mirror = [&](const Vec3& t) -> Vec3 { return 2.0 * t.dot(along) * along - t; };
    const auto ta = tangent(a), tb = tangent(b);
    if (!ta && !tb)
        return Vec3::Zero();
    return arc_offset(chord, ta ? *ta : mirror(*tb), tb ? *tb : mirror(*ta));
}

Vec3 smooth_offset(const TetMesh& mesh, const CreasedSurface& surface, const FacetEdge& e) {
    const Vec3 chord = mesh.node[static_cast<std::size_t>(e.node[1])] -
                       mesh.node[static_cast<std::size_t>(e.node[0])];
    const double d = chord.norm();
    const Vec3 along = chord / d;
    const Fan& f0 = surface.fan[static_cast<std::size_t>(e.fan[0])];
    const Fan& f1 = surface.fan[static_cast<std::size_t>(e.fan[1])];
    // Angles from the chord to the surface at its ends, positive where the surface is convex.
    const double phi0 = -std::asin(std::clamp(f0.normal.dot(along), -1.0, 1.0));
    const double phi1 = std::asin(std::clamp(f1.normal.dot(along), -1.0, 1.0));
    double phi = 0.5 * (phi0 + phi1);
    Vec3 up = f0.normal + f1.normal;
    if (f0.rank != f1.rank) {
        phi = f0.rank > f1.rank ? phi0 : phi1;
        up = f0.rank > f1.rank ? f0.normal : f1.normal;
    }
    up -= up.dot(along) * along;
    const double length = up.norm();
    return length > 0.0 ? Vec3(0.5 * d * std::tan(0.5 * phi) / length * up) : Vec3(Vec3::Zero());
}

struct MovedEdge {
    int mid;     // node
    Vec3 offset; // from the middle of the chord
    int shrinks = 0;
};

} // namespace

CurveReport curve_surface(TetMesh& mesh, const CurveOptions& options) {
    if (mesh.order != 2)
        throw InputError("only quadratic elements can be curved: promote the mesh first");
    const CreasedSurface surface = divide_at_creases(mesh, options.crease_angle);

    CurveReport report;
    report.surface_edges = surface.edge.size();
    const EdgeList edges = number_edges(mesh);
    std::vector<int> mid_of(edges.edge.size());
    for (std::size_t slot = 0; slot < edges.of_element.size(); ++slot)
        mid_of[static_cast<std::size_t>(edges.of_element[slot])] =
            mesh.nodes_of(slot / 6)[4 + slot % 6];
    std::vector<std::size_t> sorted(edges.edge.size());
    for (std::size_t i = 0; i < sorted.size(); ++i)
        sorted[i] = i;
    std::sort(sorted.begin(), sorted.end(),
              [&](std::size_t a, std::size_t b) { return edges.edge[a] < edges.edge[b]; });

    std::vector<MovedEdge> moved;
    std::vector<int> moved_at(mesh.node.size(), -1); // by mid-edge node
    constexpr double kDegree = std::numbers::pi / 180.0;
    for (const FacetEdge& e : surface.edge) {
        if (e.dihedral > 35.0 * kDegree && e.dihedral < 80.0 * kDegree)
            ++report.doubtful;
        const Vec3 offset =
            e.crease ? crease_offset(mesh, surface, e) : smooth_offset(mesh, surface, e);
        const double chord = (mesh.node[static_cast<std::size_t>(e.node[1])] -
                              mesh.node[static_cast<std::size_t>(e.node[0])])
                                 .norm();
        if (!(offset.norm() > kFlatOffset * chord))
            continue;
        const auto at = std::lower_bound(
            sorted.begin(), sorted.end(), e.node,
            [&](std::size_t i, const std::array<int, 2>& node) { return edges.edge[i] < node; });
        const int mid = mid_of[*at];
        moved_at[static_cast<std::size_t>(mid)] = static_cast<int>(moved.size());
        moved.push_back({mid, offset});
    }

    std::vector<Vec3> straight;
    for (const MovedEdge& m : moved) {
        straight.push_back(mesh.node[static_cast<std::size_t>(m.mid)]);
        mesh.node[static_cast<std::size_t>(m.mid)] += m.offset;
    }
    std::vector<bool> shorten(moved.size());
    // Ends: an element that is still bad has an edge that is still curved, and each round shortens
    // it.
    for (bool any = true; any;) {
        any = false;
        std::fill(shorten.begin(), shorten.end(), false);
        for (std::size_t e = 0; e < mesh.element_count(); ++e) {
            if (relative_jacobian(mesh, e) >= options.least_jacobian)
                continue;
            for (const int node : mesh.nodes_of(e).subspan(4))
                if (const int m = moved_at[static_cast<std::size_t>(node)];
                    m >= 0 && moved[static_cast<std::size_t>(m)].shrinks < kMostShrinks)
                    any = shorten[static_cast<std::size_t>(m)] = true;
        }
        for (std::size_t m = 0; m < moved.size(); ++m) {
            if (!shorten[m])
                continue;
            moved[m].offset *= ++moved[m].shrinks < kMostShrinks ? kShrink : 0.0;
            mesh.node[static_cast<std::size_t>(moved[m].mid)] = straight[m] + moved[m].offset;
        }
    }
    for (const MovedEdge& m : moved) {
        report.limited += m.shrinks > 0 ? 1 : 0;
        report.moved += m.shrinks < kMostShrinks ? 1 : 0;
    }
    return report;
}

} // namespace ode::soft
