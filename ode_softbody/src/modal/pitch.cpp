#include "modal/pitch.h"

#include "base/error.h"
#include "modal/band.h"
#include "modal/refine.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Up to here (a second) a solution of the order that only judges costs no more than refine().
constexpr double kDirectJudge = 5e9;
/// Up to here (two seconds) the modes of the cubic order are counted.
constexpr double kCountFlops = 20e9;
/// Pairs of nodes that an element of the cubic and the quartic order brings, at most (counted over
/// blocks and plates), and bytes that each costs in double and single precision.
constexpr double kCubicPairs = 250, kQuarticPairs = 900, kPairBytes = 120;
/// Above, the cubic order is judged by the quadratic one: no matrix but the cubic one is needed.
constexpr double kQuarticMemory = 1.5 * 0x1p30;
/// An answer, and what only judges one.
constexpr Effort kAnswered{0.03, 8}, kJudged{0.1, 8};
/// Pairs beyond those wanted that the quartic order refines along.
constexpr Index kGuards = 8;
constexpr Index kAtOnce = 32;

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

void keep_first(EigenPairs& pairs, Index count) {
    pairs.value.conservativeResize(count);
    pairs.vector.conservativeResize(Eigen::NoChange, count);
}

/// Fine pairs by refinement of the coarse ones, the last of which are guards.
EigenPairs refined_pairs(const Transfer& transfer, const EigenPairs& from, const ModalProblem& fine,
                         const TwoLevel& inverse, Effort effort) {
    const Refined refined = refine(from, transfer, fine, inverse, effort,
                                   [&](double share) { fine.tell("cubic", share); });
    EigenPairs out;
    out.value = refined.value;
    out.vector = expand(transfer, from.vector, refined);
    out.complete = from.complete;
    return out;
}

CoarseInverse by_factor(const ModalProblem& solved) {
    return [&solved](RowMatrixF& x) {
        RowMatrix wide = x.cast<double>();
        solved.factor().solve(wide);
        x = wide.cast<float>();
    };
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
/// From quadratic to cubic shells come down by up to a quarter where waves are as short as
/// elements.
constexpr double kFirstCubicReach = 1.3;

/// Widens the range of a problem, which borrows `out`, with some modes as guards.
void widen(ModalOptions& out, const ModalOptions& options, double reach) {
    out.max_frequency = reach * options.max_frequency;
    if (options.max_modes > 0)
        out.max_modes = static_cast<std::size_t>(
                            std::ceil(reach * reach * static_cast<double>(options.max_modes))) +
                        6;
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
        pair.fine = refined_pairs(transfer, pair.coarse, judge,
                                  TwoLevel(judge.system(), transfer, by_factor(problem)), kJudged);
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
            set_bands(model, pair, true, kPlain, options.rebuilt_curves ? &facets : nullptr);
        if (lost > 0 && direct && reach < kLastReach)
            continue;
        finish_bands(model);
        return model;
    }
}

/// Whether the refined answer lacks modes of the range: a mode whose quadratic frequency lay beyond
/// what was solved. Counted on the cubic order itself where its factor is cheap; elsewhere told
/// from how far the modes that are there came down, those above a little more.
/// @param fine   with guards above the `count` wanted
/// @param reach  how far beyond the range the quadratic order was solved
bool lacks_modes(ModalProblem& problem, const EigenPairs& coarse, const EigenPairs& fine,
                 Index count, double reach) {
    const Index all = fine.value.size();
    if (count == all)
        return !fine.complete; // no guard came out above the range
    if (problem.factor_flops() <= kCountFlops) {
        // Near the end of the range, where the gap is widest: Ritz values lie a little high.
        Index cut = count;
        for (Index k = count; k < std::min(all, count + 4); ++k)
            if (k > 0 && fine.value[k] / fine.value[k - 1] > fine.value[cut] / fine.value[cut - 1])
                cut = k;
        const double below = cut > 0 ? fine.value[cut - 1] : 0.0;
        return problem.modes_below(0.5 * (below + fine.value[cut])) > cut;
    }
    double most = 1;
    for (Index k = count / 2; k < count; ++k)
        most = std::max(most, std::sqrt(coarse.value[k] / fine.value[k]));
    return reach - 1 < 1.7 * (most - 1);
}

/// The quartic order's verdict on cubic pairs.
/// @param cubic  approximate inverse of the cubic stiffness
OrderPair judged_by_quartic(const ModalProblem& problem, const TwoLevel& cubic,
                            EigenPairs with_guards, const ModalOptions& options) {
    ModalOptions high = options;
    high.order = 4;
    high.mass = MassKind::kConsistent;
    const ModalProblem judge(problem.mesh(), problem.solids(), high);
    const Transfer up(problem.map(), problem.held(), judge.map(), judge.held());
    const TwoLevel inverse(judge.system(), up, [&](RowMatrixF& x) {
        const RowMatrixF right = x;
        cubic.cycle(right, x);
    });
    OrderPair pair;
    pair.fine = refined_pairs(up, with_guards, judge, inverse, kJudged);
    pair.coarse = wanted(with_guards, options);
    fill_overlap(up, judge, pair);
    return pair;
}

/// @throws InputError where matrix, factor and vectors of a refinement would not fit.
void check_memory(ModalProblem& coarse, const ModalOptions& options) {
    coarse.factor_flops();
    const double elements = static_cast<double>(coarse.mesh().element_count());
    // Some 5.5 new nodes an element, each with three numbers of two vectors a mode.
    const double vectors = 5.5 * 3 * 2 * 8 * 2 * static_cast<double>(options.max_modes);
    const double bytes = elements * (kCubicPairs * kPairBytes + vectors) +
                         1.3 * 8 * coarse.factor().factor_entries();
    if (bytes > static_cast<double>(options.memory))
        throw InputError(format("modes of this mesh at order 3 need about %.1f GiB, above the "
                                "limit of %.1f GiB: take a coarser mesh, order 2 without a band "
                                "or raise the limit",
                                bytes / 0x1p30, static_cast<double>(options.memory) / 0x1p30));
}

/// The cubic answer refined from quadratic vectors, and judged by the quartic order, or by the
/// quadratic one where that is too large. Only the quadratic order is factorised.
ModalModel cubic_from_quadratic(const TetMesh& mesh, std::span<const Solid> solids,
                                const ModalOptions& options) {
    ModalOptions low = options;
    low.order = 2;
    ModalProblem coarse(mesh, solids, low);
    check_memory(coarse, options);
    ModalProblem problem(mesh, solids, options);
    const Transfer up(coarse.map(), coarse.held(), problem.map(), problem.held());
    const TwoLevel inverse(problem.system(), up, by_factor(coarse));
    const bool quartic =
        kQuarticPairs * kPairBytes * static_cast<double>(mesh.element_count()) <= kQuarticMemory;
    for (double reach = kFirstCubicReach;; reach *= kReachStep) {
        const bool last = reach >= kLastReach;
        widen(low, options, reach);
        OrderPair pair;
        pair.coarse = coarse.solve();
        pair.fine = refined_pairs(up, pair.coarse, problem, inverse, kAnswered);
        problem.adopt_rigid_modes(coarse);
        const Index count = wanted(pair.fine, options).value.size();
        if (options.verify && !last && lacks_modes(problem, pair.coarse, pair.fine, count, reach))
            continue;
        const VectorXd facets =
            options.rebuilt_curves ? facet_change(coarse, pair.coarse, low) : VectorXd();
        if (quartic) {
            keep_first(pair.fine, std::min(pair.fine.value.size(), count + kGuards));
            pair = judged_by_quartic(problem, inverse, std::move(pair.fine), options);
        } else {
            pair.fine = wanted(pair.fine, options);
            fill_overlap(up, problem, pair);
        }
        ModalModel model = problem.model(quartic ? pair.coarse : pair.fine);
        const Rule& rule =
            quartic ? kQuartic : (options.rebuilt_curves ? kQuadraticRebuilt : kQuadratic);
        const std::size_t lost =
            set_bands(model, pair, quartic, rule, options.rebuilt_curves ? &facets : nullptr);
        if (lost > 0 && !last)
            continue;
        finish_bands(model);
        return model;
    }
}

} // namespace

ModalModel solve_with_band(const TetMesh& mesh, std::span<const Solid> solids,
                           const ModalOptions& options) {
    if (options.order == 3)
        return cubic_from_quadratic(mesh, solids, options);
    ModalOptions own = options;
    ModalProblem problem(mesh, solids, own);
    return judged_above(problem, own, options);
}

} // namespace ode::soft
