#include "modal/band.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A band is never narrower [cents]: convergence of the eigenvalues and of refine().
constexpr double kLeastBand = 0.02;

/// Columns worked on at once.
constexpr Index kAtOnce = 32;

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

} // namespace

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

void finish_bands(ModalModel& model) {
    // No partner even at the last reach: an octave, for want of a measure.
    for (double& band : model.error_cents)
        band = std::isfinite(band) ? std::max(band, kLeastBand) : 1200.0;
    sort_by_frequency(model);
}

} // namespace ode::soft
