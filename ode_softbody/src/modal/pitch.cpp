#include "modal/pitch.h"

#include "base/error.h"
#include "modal/cubic.h"
#include "modal/two_level.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Up to here (some three seconds) a direct solution of the fine order costs no more than refine(),
/// and its count can be verified.
constexpr double kDirectFlops = 20e9;
/// A band is never narrower [cents]: convergence of the eigenvalues and of refine().
constexpr double kLeastBand = 0.02;
constexpr Index kAtOnce = 32;

/// Modes of two neighbouring orders on one mesh, and how they correspond.
struct OrderPair {
    EigenPairs coarse, fine;
    MatrixXd overlap; ///< (i, k): mass product of coarse vector i and fine vector k
};

/// The fine vectors P X from + W along.
MatrixXd expand(const Transfer& transfer, const MatrixXd& coarse, const Refined& r) {
    MatrixXd out(r.correction.rows(), r.value.size());
    RowMatrix low, high;
    for (Index first = 0; first < out.cols(); first += kAtOnce) {
        const Index width = std::min(kAtOnce, out.cols() - first);
        low.noalias() = coarse * r.from.middleCols(first, width);
        transfer.up(low, high);
        high.noalias() += r.correction * r.along.middleCols(first, width);
        out.middleCols(first, width) = high;
    }
    return out;
}

void fill_overlap(const Transfer& transfer, const ModalProblem& fine, OrderPair& pair) {
    pair.overlap.resize(pair.coarse.value.size(), pair.fine.value.size());
    RowMatrix x, mx, low;
    for (Index first = 0; first < pair.overlap.cols(); first += kAtOnce) {
        const Index width = std::min(kAtOnce, pair.overlap.cols() - first);
        x = pair.fine.vector.middleCols(first, width);
        multiply_mass(fine.system(), x, mx);
        transfer.down(mx, low);
        pair.overlap.middleCols(first, width).noalias() = pair.coarse.vector.transpose() * low;
    }
}

double cents_between(double a, double b) { return 1200 * std::log2(a / b); }

/// The same shape on the other order.
struct Partner {
    double frequency; ///< [Hz]; NaN where less than half of the shape is found
    double spread;    ///< of the frequencies that it mixes [cents]
};

/// Mean of lambda weighted by squared overlap: the members of a pair, which turn freely, get the
/// pair's. A shape that mixes different frequencies isn't settled on this mesh.
Partner partner(const VectorXd& overlaps, const VectorXd& lambda) {
    const VectorXd weight = overlaps.cwiseAbs2() / overlaps.squaredNorm();
    if (!(overlaps.squaredNorm() > 0.5))
        return {std::nan(""), 0};
    const double mean = weight.dot(lambda);
    // Far ones are the fine detail that the other order lacks: that is in the mean already.
    const auto near = (lambda.array() - mean).abs() < 0.3 * mean;
    const double variance =
        near.select(weight.array() * (lambda.array() - mean).square(), 0.0).sum();
    return {frequency_of(mean), 600 / std::log(2.0) * std::sqrt(variance) / mean};
}

/// The body of the facets that the curves were guessed from: the same elements.
TetMesh faceted(const TetMesh& mesh, const std::vector<Vec3>& facets) {
    TetMesh flat = mesh;
    if (!facets.empty()) {
        flat.node = facets;
        return flat;
    }
    const auto at = [&](int node) -> Vec3& { return flat.node[static_cast<std::size_t>(node)]; };
    for (std::size_t e = 0; e < mesh.element_count() && mesh.order > 1; ++e) {
        const auto n = mesh.nodes_of(e);
        for (std::size_t k = 0; k < 6; ++k)
            at(n[4 + k]) = 0.5 * (at(n[static_cast<std::size_t>(kTetEdge[k][0])]) +
                                  at(n[static_cast<std::size_t>(kTetEdge[k][1])]));
    }
    return flat;
}

/// What the facets would change, in cents a mode by rank. A solution of its own: a Rayleigh
/// quotient of the curved body's shapes takes their bending for stretching on the facets of a thin
/// shell, and says an octave where the change is ten cents.
VectorXd facet_change(const ModalProblem& problem, const EigenPairs& pairs,
                      const ModalOptions& options) {
    const TetMesh straight = faceted(problem.mesh(), options.facets);
    ModalProblem flat(straight, problem.solids(), options);
    const VectorXd facets = flat.solve().value;
    VectorXd out = VectorXd::Constant(pairs.value.size(), std::nan(""));
    for (Index k = 0; k < std::min(out.size(), facets.size()); ++k)
        out[k] = cents_between(frequency_of(facets[k]), frequency_of(pairs.value[k]));
    return out;
}

void keep_first(EigenPairs& pairs, Index count) {
    pairs.value.conservativeResize(count);
    pairs.vector.conservativeResize(Eigen::NoChange, count);
}

/// Fine pairs up to `upper` by refinement of the coarse ones.
EigenPairs refined_pairs(const Transfer& transfer, const ModalProblem& coarse,
                         const EigenPairs& from, ModalProblem& fine, double upper) {
    const Refined refined =
        refine(coarse, from, fine, 0.03, [&](double share) { fine.tell("cubic", share); });
    EigenPairs out;
    out.value = refined.value;
    out.vector = expand(transfer, from.vector, refined);
    const Index inside = (out.value.array() <= upper).count();
    out.complete = from.complete && inside < out.value.size();
    keep_first(out, inside);
    fine.adopt_rigid_modes(coarse);
    return out;
}

/// Frequencies, bands and how many modes have no partner on the other order (their band is NaN).
std::size_t set_bands(ModalModel& model, const OrderPair& pair, bool coarse_answer,
                      const VectorXd* facets) {
    std::size_t lost = 0;
    model.error_cents.clear();
    for (std::size_t k = 0; k < model.mode_count(); ++k) {
        const auto i = static_cast<Index>(k);
        const double f = model.frequency[k];
        const Partner other = coarse_answer
                                  ? partner(pair.overlap.row(i).transpose(), pair.fine.value)
                                  : partner(pair.overlap.col(i), pair.coarse.value);
        const double change = std::abs(cents_between(f, other.frequency)) + other.spread;
        double band = (coarse_answer ? 2 : facets ? 0.7 : 0.5) * change;
        if (!coarse_answer && std::isfinite(other.frequency))
            model.frequency[k] = f - 0.1 * (other.frequency - f);
        if (facets)
            band += i < facets->size() ? 0.3 * std::abs((*facets)[i]) : std::nan("");
        lost += !std::isfinite(band);
        model.error_cents.push_back(band);
    }
    return lost;
}

} // namespace

ModalModel solve_with_band(const TetMesh& mesh, std::span<const Solid> solids,
                           const ModalOptions& options) {
    if (options.order > 3) // below, ModalProblem would take it for the cubic order
        throw InputError(
            format("element order %d is not available: take 1, 2 or 3", options.order));
    const bool coarse_answer = options.order < 3;
    ModalOptions low = options, high = options;
    low.order = coarse_answer ? options.order : 2;
    high.order = low.order + 1;
    high.mass = MassKind::kConsistent;
    low.verify = options.verify && coarse_answer;
    high.verify = options.verify && !coarse_answer;
    ModalProblem coarse(mesh, solids, low), fine(mesh, solids, high);
    const Transfer transfer(coarse.map(), coarse.held(), fine.map(), fine.held());
    // Refinement starts from a coarse order that is nearly right; linear elements are not.
    const bool direct = low.order == 1 || fine.factor_flops() <= kDirectFlops;

    OrderPair pair;
    if (coarse_answer)
        pair.coarse = coarse.solve();
    else if (direct)
        pair.fine = fine.solve();
    // The lower order is sharp, so a shape's partner may lie beyond the range asked for. Where it
    // isn't found the mesh is coarse, and the other order's range is widened.
    for (double reach = 1.2;; reach *= 1.4) {
        ModalOptions& wide = coarse_answer && direct ? high : low;
        wide.max_frequency = reach * options.max_frequency;
        if (options.max_modes > 0)
            wide.max_modes = static_cast<std::size_t>(std::ceil(
                                 reach * reach * static_cast<double>(options.max_modes))) +
                             6;
        if (!coarse_answer)
            pair.coarse = coarse.solve();
        if (!direct)
            pair.fine = refined_pairs(transfer, coarse, pair.coarse, fine,
                                      eigenvalue_of(options.max_frequency));
        else if (coarse_answer)
            pair.fine = fine.solve();
        ModalProblem& problem = coarse_answer ? coarse : fine;
        EigenPairs& answer = coarse_answer ? pair.coarse : pair.fine;
        if (options.max_modes > 0)
            keep_first(answer,
                       std::min(answer.value.size(), static_cast<Index>(options.max_modes)));
        fill_overlap(transfer, fine, pair);
        ModalModel model = problem.model(answer);
        const VectorXd facets =
            options.rebuilt_curves
                ? (direct ? facet_change(problem, answer, coarse_answer ? low : high)
                          : facet_change(coarse, pair.coarse, low))
                : VectorXd();
        const std::size_t lost =
            set_bands(model, pair, coarse_answer, options.rebuilt_curves ? &facets : nullptr);
        if (lost > 0 && reach < 2.3 && !(coarse_answer && !direct))
            continue;
        // No partner even at 2.3 times the frequency: an octave, for want of a measure.
        for (double& band : model.error_cents)
            band = std::isfinite(band) ? std::max(band, kLeastBand) : 1200.0;
        sort_by_frequency(model); // the correction may exchange neighbours
        return model;
    }
}

} // namespace ode::soft
