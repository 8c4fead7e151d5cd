#include "modal/modal_problem.h"

#include "base/error.h"
#include "modal/rigid_motion.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

using Eigen::Index;

/// Nodes that some element uses; TetMesh may hold others.
void check_options(const TetMesh& mesh, const ModalOptions& options) {
    if (mesh.element_count() == 0)
        throw InputError("the mesh has no tetrahedra: there is nothing to vibrate");
    if (options.order < 1 || options.order > 3)
        throw InputError(format("element order %d is not available: take 1, 2 or 3",
                                options.order));
    if (!(options.max_frequency > 0) || !std::isfinite(options.max_frequency))
        throw InputError(format("the highest frequency asked for is %g Hz: it must be positive",
                                options.max_frequency));
    if (options.clamp && options.clamped.empty())
        throw InputError("the clamp catches no node: check its axis and its value in metres "
                         "against the bounds of the mesh");
}

double largest_ratio(const BlockSystem& s) {
    double most = 0;
    for (std::size_t i = 0; i < s.node_count(); ++i)
        for (int p = s.start[i]; p < s.start[i + 1]; ++p)
            if (s.column[static_cast<std::size_t>(p)] == static_cast<int>(i)) {
                const double* k = &s.stiffness[9 * static_cast<std::size_t>(p)];
                most = std::max(most, std::max({k[0], k[4], k[8]}) /
                                          s.mass[static_cast<std::size_t>(p)]);
            }
    return most;
}

} // namespace

void ModalProblem::tell(const char* stage, double share, std::size_t modes) const {
    if (options_.progress && !options_.progress({stage, share, modes}))
        throw Cancelled{};
}

ModalProblem::ModalProblem(const TetMesh& mesh, std::span<const Solid> solids,
                           const ModalOptions& options)
    : mesh_(mesh), solids_(solids), options_(options) {
    check_options(mesh, options);
    check_solids(mesh, solids);
    tell("assemble", 0);
    map_ = number_nodes(mesh, options.order);
    free_.assign(map_.node_count(), 1);
    const std::vector<char> clamped = clamped_nodes(mesh, map_, options.clamped);
    for (std::size_t i = 0; i < free_.size(); ++i)
        free_[i] = !clamped[i];
    const auto held = std::count(free_.begin(), free_.end(), 0);
    if (held == static_cast<std::ptrdiff_t>(free_.size()))
        throw InputError(format("the clamp holds all %zu nodes: nothing is left to vibrate",
                                free_.size()));
    if (!options.clamped.empty() && held == 0)
        throw InputError("the clamped nodes belong to no tetrahedron: the clamp holds nothing");
    BlockSystem all = assemble(mesh, map_, solids, options.mass);
    rigid_ = free_rigid_motions(all, free_);
    rigid_modes_ = static_cast<int>(rigid_.cols());
    system_ = held ? restrict_to(all, free_) : std::move(all);
    tell("assemble", 1);
}

EigenPairs ModalProblem::solve(Index guards) {
    factor_ = std::make_unique<BlockFactor>(system_);
    const double bytes = 1.3 * 8 * factor_->factor_entries() + // fronts in flight: some 30 %
                         96.0 * static_cast<double>(system_.column.size());
    if (bytes > static_cast<double>(options_.memory))
        throw InputError(format("modes of this mesh at order %d need about %.1f GiB, above the "
                                "limit of %.1f GiB: take a coarser mesh, a lower order or raise "
                                "the limit",
                                options_.order, bytes / 0x1p30,
                                static_cast<double>(options_.memory) / 0x1p30));
    // Small against any elastic eigenvalue, large against the rounding of K (some 1e-15 of its
    // largest eigenvalue), so that K + shift M is positive definite in floating point too.
    shift_ = 1e-10 * largest_ratio(system_);
    const auto step = [&](double share) { return tell("factorise", share), true; };
    factor_->factorise(system_, shift_, true, step);

    LanczosOptions lanczos;
    lanczos.upper = eigenvalue_of(options_.max_frequency);
    lanczos.max_pairs = static_cast<Index>(options_.max_modes);
    if (lanczos.max_pairs > 0)
        lanczos.max_pairs += guards;
    lanczos.progress = [&](Index count, double share) {
        return tell("modes", share, static_cast<std::size_t>(count)), true;
    };
    EigenPairs pairs = lowest_pairs(system_, *factor_, shift_, rigid_, lanczos);

    // By Sylvester's law of inertia K - sigma M has as many negative pivots as there are
    // eigenvalues below sigma. A miss is looked for again, away from all that is known.
    for (int attempt = 0; options_.verify && attempt < 3; ++attempt) {
        tell("verify", 0, static_cast<std::size_t>(pairs.value.size()));
        const double last = pairs.value.size() ? pairs.value[pairs.value.size() - 1] : 0.0;
        const double sigma = 0.5 * (last + pairs.beyond);
        BlockFactor counter(*factor_, BlockFactor::kSymbolic);
        counter.factorise(system_, -sigma, false, step);
        const Index missing =
            counter.negative_pivots() - rigid_.cols() - pairs.value.size();
        if (missing <= 0 || !(pairs.beyond > last * (1 + 1e-9)))
            break;
        RowMatrix known(system_.size(), rigid_.cols() + pairs.vector.cols());
        known << rigid_, pairs.vector;
        lanczos.upper = std::min(lanczos.upper, sigma);
        lanczos.max_pairs = 0;
        const EigenPairs more = lowest_pairs(system_, *factor_, shift_, known, lanczos,
                                             static_cast<unsigned>(attempt) + 2);
        merge(pairs, more);
    }
    return pairs;
}

} // namespace ode::soft
