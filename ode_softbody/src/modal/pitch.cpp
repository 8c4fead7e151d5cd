#include "modal/pitch.h"

#include "modal/cubic.h"
#include "modal/two_level.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Up to here (some three seconds) the cubic order is factorised, and its count can be verified;
/// above, it is refined from the quadratic vectors.
constexpr double kDirectFlops = 20e9;
/// Of a few partials, which the quartic order judges cheaply (half a minute): a refined mesh must
/// not fall back on the wider band, or no tolerance would be met on it.
constexpr double kDirectFlopsOfFew = 200e9;
constexpr std::size_t kFew = 16;
/// Up to here (a second) a solution of the order that only judges costs no more than refine().
constexpr double kDirectJudge = 5e9;
/// A band is never narrower [cents]: convergence of the eigenvalues and of refine().
constexpr double kLeastBand = 0.02;

/// From the change d that one order more makes, f_p - f_{p+1}: the answer f_p - shift d and its
/// band, width |d|. The spaces are nested, so eigenvalues fall towards the truth.
struct Rule {
    double shift, width;
};
/// Orders 1 and 2 as they are, their bands generous.
constexpr Rule kPlain{0, 2};
/// Cubic, judged by quartic. What the quartic order leaves is e4 = g d. With lambda's error as
/// p^(-4a) at an edge of singularity a (Babuska and Suri 1994, doi:10.1137/1036141): g = 0.8 at a
/// clamped right-angled edge (a = 0.71), and toward zero where the shape is smooth. The middle,
/// 0.4, is the answer; the band reaches both ends, and 0.05 more for what refine() leaves.
constexpr Rule kQuartic{1.4, 0.45};
/// Cubic, judged by quadratic, where the mesh is too large for more: d is f3 - f2, negative. Curves
/// that were rebuilt cost both orders more than they show.
constexpr Rule kQuadratic{-0.1, 0.5}, kQuadraticRebuilt{-0.1, 0.7};

/// What a step of refine() may leave of the change (see TwoLevel::solve): of an answer, of what
/// only judges one.
constexpr double kAnswered = 0.03, kJudged = 0.1;
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

/// Fine pairs by refinement of the coarse ones, the last of which are guards.
EigenPairs refined_pairs(const Transfer& transfer, const ModalProblem& coarse,
                         const EigenPairs& from, ModalProblem& fine, double share_left) {
    const Refined refined =
        refine(coarse, from, fine, share_left, [&](double share) { fine.tell("cubic", share); });
    EigenPairs out;
    out.value = refined.value;
    out.vector = expand(transfer, from.vector, refined);
    out.complete = from.complete;
    fine.adopt_rigid_modes(coarse);
    return out;
}

/// Keeps the pairs up to the frequency and number asked for.
EigenPairs wanted(const EigenPairs& pairs, const ModalOptions& options) {
    EigenPairs out = pairs;
    const Index inside = (out.value.array() <= eigenvalue_of(options.max_frequency)).count();
    out.complete = out.complete && inside < out.value.size();
    keep_first(out, options.max_modes > 0 ? std::min(inside, static_cast<Index>(options.max_modes))
                                          : inside);
    return out;
}

/// A shape's partner may lie beyond the range asked for. Where it isn't found the mesh is coarse,
/// and the other order's range is widened, so far.
constexpr double kFirstReach = 1.2, kReachStep = 1.4, kLastReach = 2.3;

/// Widens the range of a problem, which borrows `out`, with some modes as guards.
void widen(ModalOptions& out, const ModalOptions& options, double reach) {
    out.max_frequency = reach * options.max_frequency;
    if (options.max_modes > 0)
        out.max_modes = static_cast<std::size_t>(
                            std::ceil(reach * reach * static_cast<double>(options.max_modes))) +
                        6;
}

/// How far an answer is from its partner on the other order decides value and band.
/// @return how many modes have no partner: their band is NaN.
std::size_t set_bands(ModalModel& model, const OrderPair& pair, bool coarse_answer,
                      const Rule& rule, const VectorXd* facets) {
    std::size_t lost = 0;
    model.error_cents.clear();
    for (std::size_t k = 0; k < model.mode_count(); ++k) {
        const auto i = static_cast<Index>(k);
        const double f = model.frequency[k];
        const Partner other = coarse_answer
                                  ? partner(pair.overlap.row(i).transpose(), pair.fine.value)
                                  : partner(pair.overlap.col(i), pair.coarse.value);
        const double change = std::abs(cents_between(f, other.frequency)) + other.spread;
        double band = rule.width * change;
        if (std::isfinite(other.frequency))
            model.frequency[k] = f - rule.shift * (f - other.frequency);
        if (facets)
            band += i < facets->size() ? 0.3 * std::abs((*facets)[i]) : std::nan("");
        lost += !std::isfinite(band);
        model.error_cents.push_back(band);
    }
    return lost;
}

void finish(ModalModel& model) {
    // No partner even at the last reach: an octave, for want of a measure.
    for (double& band : model.error_cents)
        band = std::isfinite(band) ? std::max(band, kLeastBand) : 1200.0;
    sort_by_frequency(model); // the correction may exchange neighbours
}

/// The answer on the problem's order, judged by the next one up.
/// @param own  what the problem borrows
ModalModel judged_above(ModalProblem& problem, ModalOptions& own, const ModalOptions& options) {
    ModalOptions high = options;
    high.order = options.order + 1;
    high.mass = MassKind::kConsistent;
    high.verify = false;
    ModalProblem judge(problem.mesh(), problem.solids(), high);
    // Refinement starts from an order that is nearly right; linear elements are not.
    const bool direct = options.order == 1 || judge.factor_flops() <= kDirectJudge;
    if (!direct)
        widen(own, options, kFirstReach);
    const Transfer transfer(problem.map(), problem.held(), judge.map(), judge.held());
    OrderPair pair;
    pair.coarse = problem.solve();
    const EigenPairs answer = wanted(pair.coarse, options);
    if (!direct)
        pair.fine = refined_pairs(transfer, problem, pair.coarse, judge, kJudged);
    pair.coarse = answer;
    const VectorXd facets =
        options.rebuilt_curves ? facet_change(problem, answer, options) : VectorXd();
    for (double reach = kFirstReach;; reach *= kReachStep) {
        if (direct) {
            widen(high, options, reach);
            pair.fine = judge.solve();
        }
        fill_overlap(transfer, judge, pair);
        ModalModel model = problem.model(answer);
        const std::size_t lost =
            set_bands(model, pair, true, options.order == 3 ? kQuartic : kPlain,
                      options.rebuilt_curves ? &facets : nullptr);
        if (lost > 0 && direct && reach < kLastReach)
            continue;
        finish(model);
        return model;
    }
}

/// The cubic answer refined from quadratic vectors, and judged by them.
ModalModel judged_below(ModalProblem& problem, const ModalOptions& options) {
    ModalOptions low = options;
    low.order = 2;
    low.verify = false;
    ModalProblem coarse(problem.mesh(), problem.solids(), low);
    const Transfer transfer(coarse.map(), coarse.held(), problem.map(), problem.held());
    OrderPair pair;
    for (double reach = kFirstReach;; reach *= kReachStep) {
        widen(low, options, reach);
        pair.coarse = coarse.solve();
        pair.fine =
            wanted(refined_pairs(transfer, coarse, pair.coarse, problem, kAnswered), options);
        fill_overlap(transfer, problem, pair);
        ModalModel model = problem.model(pair.fine);
        const VectorXd facets =
            options.rebuilt_curves ? facet_change(coarse, pair.coarse, low) : VectorXd();
        const std::size_t lost =
            set_bands(model, pair, false, options.rebuilt_curves ? kQuadraticRebuilt : kQuadratic,
                      options.rebuilt_curves ? &facets : nullptr);
        if (lost > 0 && reach < kLastReach)
            continue;
        finish(model);
        return model;
    }
}

} // namespace

ModalModel solve_with_band(const TetMesh& mesh, std::span<const Solid> solids,
                           const ModalOptions& options) {
    ModalOptions own = options;
    ModalProblem problem(mesh, solids, own);
    const bool few = options.max_modes > 0 && options.max_modes <= kFew;
    if (options.order == 3 && problem.factor_flops() > (few ? kDirectFlopsOfFew : kDirectFlops))
        return judged_below(problem, options);
    return judged_above(problem, own, options);
}

} // namespace ode::soft
