#include "modal/modal_problem.h"

#include "base/error.h"
#include "modal/lagrange.h"
#include "modal/rigid_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode::soft {
namespace {

using Eigen::Index;

void check_options(const TetMesh& mesh, const ModalOptions& options) {
    if (mesh.element_count() == 0)
        throw InputError("the mesh has no tetrahedra: there is nothing to vibrate");
    if (options.order < 1 || options.order > kMaxOrder)
        throw InputError(
            format("element order %d is not available: take 1 to %d", options.order, kMaxOrder));
    if (!(options.max_frequency > 0) || !std::isfinite(options.max_frequency))
        throw InputError(format("the highest frequency asked for is %g Hz: it must be positive",
                                options.max_frequency));
    if (options.clamp && options.clamped.empty())
        throw InputError("the clamp catches no node: check its axis and its value in metres "
                         "against the bounds of the mesh");
}

/// Makes the largest component positive; of components equal to six digits the first decides, so
/// that rounding doesn't.
void fix_sign(double* shape, std::size_t size) {
    double most = 0;
    for (std::size_t i = 0; i < size; ++i)
        most = std::max(most, std::abs(shape[i]));
    std::size_t first = 0;
    while (first < size && std::abs(shape[first]) < (1 - 1e-6) * most)
        ++first;
    if (first < size && shape[first] < 0)
        for (std::size_t i = 0; i < size; ++i)
            shape[i] = -shape[i];
}

/// Upper range of K's diagonal against M's [1/s^2].
double largest_ratio(const BlockSystem& s) {
    double most = 0;
    for (std::size_t i = 0; i < s.node_count(); ++i)
        for (int p = s.start[i]; p < s.start[i + 1]; ++p)
            if (s.column[static_cast<std::size_t>(p)] == static_cast<int>(i)) {
                const double* k = &s.stiffness[9 * static_cast<std::size_t>(p)];
                most = std::max(most,
                                std::max({k[0], k[4], k[8]}) / s.mass[static_cast<std::size_t>(p)]);
            }
    return most;
}

/// Directions held at nodes that stay in the system: uncoupled from everything and given a spring
/// that puts them at 1e4 times the body's largest eigenvalue, so they share in a mode at lambda by
/// less than 1e-4 lambda / top.
void hold_rollers(BlockSystem& s, const std::vector<char>& held, double top) {
    for (std::size_t i = 0; i < s.node_count(); ++i)
        for (int p = s.start[i]; p < s.start[i + 1]; ++p) {
            const auto pair = static_cast<std::size_t>(p);
            const auto j = static_cast<std::size_t>(s.column[pair]);
            double* k = &s.stiffness[9 * pair];
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    if (held[i] != 7 && held[j] != 7 && ((held[i] >> r & 1) || (held[j] >> c & 1)))
                        k[3 * r + c] = i == j && r == c ? 1e4 * top * s.mass[pair] : 0.0;
        }
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
    held_.assign(map_.node_count(), 0);
    hold(options.clamped, 7);
    for (int axis = 0; axis < 3; ++axis)
        hold(options.rollers[static_cast<std::size_t>(axis)], static_cast<char>(1 << axis));
    std::vector<char> keep(held_.size());
    for (std::size_t i = 0; i < held_.size(); ++i)
        keep[i] = held_[i] != 7;
    const auto clamped = std::count(keep.begin(), keep.end(), 0);
    if (clamped == static_cast<std::ptrdiff_t>(keep.size()))
        throw InputError(
            format("the clamp holds all %zu nodes: nothing is left to vibrate", keep.size()));
    if (!options.clamped.empty() && clamped == 0)
        throw InputError("the clamped nodes belong to no tetrahedron: the clamp holds nothing");
    BlockSystem all = assemble(mesh, map_, solids, options.mass);
    rigid_ = free_rigid_motions(all, held_);
    rigid_modes_ = static_cast<int>(rigid_.cols());
    // Small against any elastic eigenvalue, large against the rounding of K (some 1e-15 of its
    // largest eigenvalue), so that K + shift M is positive definite in floating point too.
    const double top = largest_ratio(all);
    shift_ = 1e-10 * top;
    hold_rollers(all, held_, top);
    system_ = clamped ? restrict_to(all, keep) : std::move(all);
    tell("assemble", 1);
}

void ModalProblem::hold(std::span<const int> mesh_nodes, char axes) {
    if (mesh_nodes.empty())
        return;
    const std::vector<char> flag = clamped_nodes(mesh_, map_, mesh_nodes);
    for (std::size_t i = 0; i < flag.size(); ++i)
        held_[i] = static_cast<char>(held_[i] | (flag[i] ? axes : 0));
}

double ModalProblem::factor_flops() {
    if (!factor_)
        factor_ = std::make_unique<BlockFactor>(system_);
    return factor_->factor_flops();
}

EigenPairs ModalProblem::solve() {
    factor_flops();
    const double bytes = 1.3 * 8 * factor_->factor_entries() + // fronts in flight: some 30 %
                         96.0 * static_cast<double>(system_.column.size());
    if (bytes > static_cast<double>(options_.memory))
        throw InputError(format("modes of this mesh at order %d need about %.1f GiB, above the "
                                "limit of %.1f GiB: take a coarser mesh, a lower order or raise "
                                "the limit",
                                options_.order, bytes / 0x1p30,
                                static_cast<double>(options_.memory) / 0x1p30));
    const auto step = [&](double share) { return tell("factorise", share), true; };
    factor_->factorise(system_, shift_, true, step);

    LanczosOptions lanczos;
    lanczos.upper = eigenvalue_of(options_.max_frequency);
    lanczos.max_pairs = static_cast<Index>(options_.max_modes);
    lanczos.progress = [&](Index count, double share) {
        return tell("modes", share, static_cast<std::size_t>(count)), true;
    };
    EigenPairs pairs = lowest_pairs(system_, *factor_, shift_, rigid_, lanczos);

    for (unsigned attempt = 2; options_.verify && attempt < 5 && verify(pairs, attempt, lanczos);
         ++attempt) {
    }

    // What has no energy although it isn't a rigid motion of a part: parts hinged at a node or an
    // edge. The bound is a thousandth of the shift, a thousand times its rounding.
    const Index idle = (pairs.value.array() < 1e-3 * shift_).count();
    rigid_modes_ = static_cast<int>(rigid_.cols() + idle);
    pairs.value = pairs.value.tail(pairs.value.size() - idle).eval();
    pairs.vector = pairs.vector.rightCols(pairs.value.size()).eval();
    return pairs;
}

Index ModalProblem::modes_below(double eigenvalue) {
    factor_flops();
    factor_->factorise(system_, -eigenvalue, false,
                       [&](double share) { return tell("verify", share), true; });
    return factor_->negative_pivots() - rigid_modes_;
}

/// By Sylvester's law of inertia K - sigma M has as many negative pivots as there are eigenvalues
/// below sigma. What is missing is looked for away from all that is known.
/// @return true if something was missing.
bool ModalProblem::verify(EigenPairs& pairs, unsigned seed, LanczosOptions lanczos) {
    tell("verify", 0, static_cast<std::size_t>(pairs.value.size()));
    const double last = pairs.value.size() ? pairs.value[pairs.value.size() - 1] : 0.0;
    if (!(pairs.beyond > last * (1 + 1e-9)))
        return false; // the limit on the number cuts between equal pairs
    const double sigma = 0.5 * (last + pairs.beyond);
    if (modes_below(sigma) <= pairs.value.size())
        return false;
    RowMatrix known(system_.size(), rigid_.cols() + pairs.vector.cols());
    known << rigid_, pairs.vector;
    lanczos.upper = std::min(lanczos.upper, sigma);
    lanczos.max_pairs = 0;
    const EigenPairs more = lowest_pairs(system_, *factor_, shift_, known, lanczos, seed);
    if (more.value.size() == 0)
        return false;
    std::vector<std::pair<double, Index>> sorted;
    const Index old = pairs.value.size(), all = old + more.value.size();
    for (Index i = 0; i < all; ++i)
        sorted.emplace_back(i < old ? pairs.value[i] : more.value[i - old], i);
    std::sort(sorted.begin(), sorted.end());
    EigenPairs merged;
    merged.complete = pairs.complete;
    merged.beyond = pairs.beyond;
    merged.value.resize(all);
    merged.vector.resize(system_.size(), all);
    for (Index k = 0; k < all; ++k) {
        const auto [value, i] = sorted[static_cast<std::size_t>(k)];
        merged.value[k] = value;
        merged.vector.col(k) =
            (i < old ? std::as_const(pairs) : more).vector.col(i < old ? i : i - old);
    }
    pairs = std::move(merged);
    return true;
}

ModalModel ModalProblem::model(const EigenPairs& pairs) const {
    ModalModel out;
    out.body = mass_properties(mesh_, solids_);
    out.node_count = mesh_.node.size();
    out.rigid_modes = rigid_modes_;
    out.complete = pairs.complete;
    const auto modes = static_cast<std::size_t>(pairs.value.size());
    out.frequency.resize(modes);
    out.shape.assign(modes * 3 * out.node_count, 0.0);
    std::vector<int> row(map_.node_count(), -1);
    int next = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
        if (held_[i] != 7)
            row[i] = 3 * next++;
    RowMatrix x, kx, mx;
    constexpr Index kAtOnce = 8;
    for (Index first = 0; first < pairs.value.size(); first += kAtOnce) {
        x = pairs.vector.middleCols(first, std::min(kAtOnce, pairs.value.size() - first));
        multiply_stiffness(system_, x, kx);
        multiply_mass(system_, x, mx);
        for (Index c = 0; c < x.cols(); ++c) {
            const double mass = x.col(c).dot(mx.col(c));
            const auto mode = static_cast<std::size_t>(first + c);
            out.frequency[mode] = frequency_of(x.col(c).dot(kx.col(c)) / mass);
            double* shape = out.shape.data() + mode * 3 * out.node_count;
            const Eigen::VectorXd u = x.col(c) / std::sqrt(mass);
            for (std::size_t i = 0; i < out.node_count; ++i)
                for (int t = map_.mesh_start[i]; t < map_.mesh_start[i + 1]; ++t) {
                    const auto& [node, weight] = map_.mesh_term[static_cast<std::size_t>(t)];
                    if (const int r = row[static_cast<std::size_t>(node)]; r >= 0)
                        for (int axis = 0; axis < 3; ++axis)
                            shape[3 * i + static_cast<std::size_t>(axis)] += weight * u[r + axis];
                }
            fix_sign(shape, 3 * out.node_count);
        }
    }
    return out;
}

std::vector<Eigen::Index> ModalProblem::mesh_rows() const {
    std::vector<Eigen::Index> row(map_.node_count(), -1);
    Eigen::Index next = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
        if (held_[i] != 7)
            row[i] = 3 * next++;
    std::vector<Eigen::Index> out(mesh_.node.size(), -1);
    for (std::size_t i = 0; i < out.size(); ++i)
        if (map_.mesh_start[i + 1] - map_.mesh_start[i] == 1)
            out[i] = row[static_cast<std::size_t>(
                map_.mesh_term[static_cast<std::size_t>(map_.mesh_start[i])].node)];
    return out;
}

} // namespace ode::soft
