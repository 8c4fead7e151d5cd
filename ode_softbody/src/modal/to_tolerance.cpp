#include "modal/to_tolerance.h"

#include "base/error.h"
#include "mesh/promote.h"
#include "mesh/refine.h"
#include "modal/cache.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode::soft {
namespace {

/// A refinement that leaves more than this of the band is the last: elements of order 2 and 3
/// gain at least a factor of two, even at a clamp's corner.
constexpr double kStalled = 0.8;

/// A mesh on the way to the tolerance.
struct Level {
    TetMesh mesh;
    std::vector<Vec3> facets; ///< where its nodes lie on the body as given
    ModalOptions options;     ///< supports by this mesh's nodes
    CurveReport curve;
    bool rebuilt = false; ///< here or on a coarser level
};

/// Adds the middles of edges whose both ends are listed.
void extend_to_edges(const TetMesh& quadratic, std::vector<int>& nodes) {
    if (nodes.empty())
        return;
    std::vector<char> listed(quadratic.node.size(), 0);
    for (const int node : nodes) // a bad index is refused where the supports are applied
        if (node >= 0 && static_cast<std::size_t>(node) < listed.size())
            listed[static_cast<std::size_t>(node)] = 1;
    for (std::size_t e = 0; e < quadratic.element_count(); ++e) {
        const auto n = quadratic.nodes_of(e);
        for (std::size_t k = 0; k < 6; ++k) {
            char& mid = listed[static_cast<std::size_t>(n[4 + k])];
            const auto end = [&](int i) {
                return listed[static_cast<std::size_t>(
                    n[static_cast<std::size_t>(kTetEdge[k][i])])];
            };
            if (!mid && end(0) && end(1)) {
                mid = 1;
                nodes.push_back(n[4 + k]);
            }
        }
    }
}

/// The same body in quadratic elements.
Level promoted(const Level& level) {
    if (level.mesh.order == 2)
        return level;
    Level out = level;
    TetMesh flat = level.mesh;
    flat.node = level.facets;
    out.mesh = promote_to_quadratic(level.mesh);
    out.facets = promote_to_quadratic(flat).node;
    extend_to_edges(out.mesh, out.options.clamped);
    for (std::vector<int>& roller : out.options.rollers)
        extend_to_edges(out.mesh, roller);
    return out;
}

/// Linear elements get their curves back, if there are any.
Level rebuilt(Level level, bool wanted) {
    if (wanted && level.mesh.order == 1) {
        Level curved = promoted(level);
        curved.curve = level.curve = curve_surface(curved.mesh);
        // Where many offsets don't fit into the elements (a shell thinner than its facets' sagitta
        // asks for), half-curved elements are worse than flat ones: a bowl of 20 facets round rose
        // from 25 cents of error to 120.
        if (curved.curve.moved > 4 * curved.curve.limited) {
            curved.rebuilt = true;
            level = std::move(curved);
        }
    }
    level.options.rebuilt_curves = level.rebuilt;
    level.options.facets = level.rebuilt ? level.facets : std::vector<Vec3>();
    return level;
}

Level finer(const Level& level, bool rebuild) {
    Level out = promoted(level);
    out.mesh = refine_uniformly(out.mesh);
    return rebuilt(std::move(out), rebuild);
}

/// Nodes of the level's refinement, promoted: each refinement brings some seven to eight times as
/// many; eight is for bulk.
std::size_t nodes_after(const Level& level) {
    const std::size_t nodes = level.mesh.order == 2 ? level.mesh.node.size()
                                                    : promote_to_quadratic(level.mesh).node.size();
    return 8 * nodes;
}

double widest_band(const ModalModel& model, std::size_t partials) {
    double widest = 0;
    for (std::size_t k = 0; k < std::min(partials, model.error_cents.size()); ++k)
        widest = std::max(widest, model.error_cents[k]);
    return widest;
}

[[noreturn]] void refuse(double band, const ToleranceOptions& wanted, const Level& level,
                         int refinements, const std::string& why) {
    throw InputError(format("the estimated error is %.3g cents, %.3g asked for, after %d "
                            "refinements (%zu nodes): %s",
                            band, wanted.cents, refinements, level.mesh.node.size(), why.c_str()));
}

/// Drops the nodes that refinement added: the given ones come first on each level.
void keep_given_nodes(ModalModel& model, std::size_t nodes) {
    if (model.node_count == nodes)
        return;
    std::vector<double> shape;
    shape.reserve(3 * nodes * model.mode_count());
    for (std::size_t k = 0; k < model.mode_count(); ++k) {
        const auto given = model.shape_of(k).first(3 * nodes);
        shape.insert(shape.end(), given.begin(), given.end());
    }
    model.shape = std::move(shape);
    model.node_count = nodes;
}

} // namespace

TolerantModes modes_to_tolerance(const TetMesh& mesh, std::span<const Solid> solids,
                                 const ModalOptions& options, const ToleranceOptions& tolerance) {
    const auto solve = [&](const Level& level, std::size_t most) {
        ModalOptions o = level.options;
        o.max_modes = most;
        return cached_modes(level.mesh, solids, o, tolerance.cache);
    };
    Level level = rebuilt({mesh, mesh.node, options, {}, false}, tolerance.rebuild_curves);
    TolerantModes out;
    out.curve = level.curve;
    if (tolerance.cents > 0) {
        const std::size_t judged = options.max_modes
                                       ? std::min(options.max_modes, tolerance.partials)
                                       : tolerance.partials;
        out.model = solve(level, judged);
        double band = widest_band(out.model, judged);
        while (band > tolerance.cents) {
            if (const std::size_t next = nodes_after(level); next > tolerance.max_nodes)
                refuse(band, tolerance, level, out.refinements,
                       format("the next would take about %zu nodes, beyond the limit of %zu; raise "
                              "the limit, ask for less, or mesh thin parts with elements about as "
                              "wide as the part is thick",
                              next, tolerance.max_nodes));
            const double before = std::exchange(band, 0.0);
            try {
                Level next = finer(level, tolerance.rebuild_curves);
                out.model = solve(next, judged);
                level = std::move(next);
            } catch (const InputError& error) {
                refuse(before, tolerance, level, out.refinements,
                       format("refined once more, %s", error.what()));
            }
            ++out.refinements;
            band = widest_band(out.model, judged);
            if (band > tolerance.cents && band > kStalled * before)
                refuse(band, tolerance, level, out.refinements,
                       level.rebuilt
                           ? "refining no longer narrows it, because the true surface between the "
                             "given facets is in doubt; bring a mesh with finer facets or with "
                             "second-order elements"
                           : "refining no longer narrows it; ask for less");
        }
        if (judged != options.max_modes)
            out.model = solve(level, options.max_modes);
    } else {
        out.model = solve(level, options.max_modes);
    }
    out.nodes = level.mesh.node.size();
    keep_given_nodes(out.model, mesh.node.size());
    return out;
}

} // namespace ode::soft
