#include "integrate/static_equilibrium.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double kDescent = 1e-4; ///< share of the slope that a step must fall by (Armijo)
constexpr int kHalvings = 40;

double largest(const VectorXd& r) {
    double most = 0;
    for (Index i = 0; i < r.size(); i += 3)
        most = std::max(most, r.segment<3>(i).norm());
    return most;
}

/// One body under one load.
class Problem {
public:
    Problem(const ElasticModel& model, std::span<const char> free, NodeArray& position)
        : model_(model), free_(free), position_(position), still_(position.size()),
          force_(position.size()) {}

    /// All force on free nodes, 0 on held ones.
    VectorXd residual(const VectorXd& load) {
        force_.set_zero();
        model_.add_force(position_, still_, force_);
        VectorXd r = VectorXd::Zero(load.size());
        reaction_ = 0;
        for (std::size_t i = 0; i < position_.size(); ++i)
            if (free_[i])
                r.segment<3>(at(i)) = force_[i] + load.segment<3>(at(i));
            else
                reaction_ = std::max(reaction_, force_[i].norm());
        return r;
    }
    /// Force that rounding of the positions makes, once there was a direction() [N].
    double rounding() const { return rounding_; }
    double reaction() const { return reaction_; } ///< largest on a held node, at the last residual

    double potential(const VectorXd& load) const {
        double work = 0;
        for (std::size_t i = 0; i < position_.size(); ++i)
            work += load.segment<3>(at(i)).dot(position_[i]);
        return model_.energy(position_) - work;
    }

    void move(const VectorXd& by, double share) {
        for (std::size_t i = 0; i < position_.size(); ++i)
            position_[i] += share * by.segment<3>(at(i));
    }

    /// Newton's direction, or that of a tangent shifted into convexity. Its product with r is
    /// positive.
    VectorXd direction(const VectorXd& r) {
        Sparse k = model_.stiffness(position_);
        double diagonal = 0;
        for (Index column = 0; column < k.outerSize(); ++column)
            for (Sparse::InnerIterator it(k, column); it; ++it) {
                if (!free_[node(it.row())] || !free_[node(column)])
                    it.valueRef() = it.row() == column ? 1.0 : 0.0;
                else if (it.row() == column)
                    diagonal = std::max(diagonal, std::abs(it.value()));
            }
        double extent = 0;
        for (std::size_t i = 0; i < position_.size(); ++i)
            extent = std::max(extent, position_[i].cwiseAbs().maxCoeff());
        rounding_ = 4 * std::numeric_limits<double>::epsilon() * diagonal * extent;
        if (!analysed_)
            factor_.analyzePattern(k);
        analysed_ = true;
        for (double shift = 0; shift<diagonal; shift = shift> 0 ? 8 * shift : 1e-9 * diagonal) {
            factor_.setShift(shift);
            factor_.factorize(k);
            if (factor_.info() != Eigen::Success || !(factor_.vectorD().minCoeff() > 0))
                continue;
            const VectorXd step = factor_.solve(r);
            if (step.allFinite() && step.dot(r) > 0)
                return step;
        }
        return r / diagonal;
    }

private:
    static Index at(std::size_t node) { return 3 * static_cast<Index>(node); }
    static std::size_t node(Index row) { return static_cast<std::size_t>(row / 3); }

    const ElasticModel& model_;
    std::span<const char> free_;
    NodeArray& position_;
    NodeArray still_, force_;
    double reaction_ = 0, rounding_ = 0;
    Eigen::SimplicialLDLT<Sparse> factor_;
    bool analysed_ = false;
};

} // namespace

Equilibrium find_equilibrium(const ElasticModel& model, std::span<const char> free,
                             const NodeArray& load, NodeArray& position,
                             const EquilibriumOptions& options) {
    VectorXd whole = VectorXd::Zero(3 * static_cast<Index>(load.size()));
    for (std::size_t i = 0; i < load.size(); ++i)
        if (free[i])
            whole.segment<3>(3 * static_cast<Index>(i)) = load[i];
    const double scale = largest(whole);
    Problem problem(model, free, position);
    Equilibrium out;
    for (int share = 1; share <= options.load_steps; ++share) {
        const VectorXd now = whole * (double(share) / options.load_steps);
        out.converged = false;
        for (int i = 0; i <= options.max_iterations; ++i) {
            const VectorXd r = problem.residual(now);
            const double acting = std::max(scale, problem.reaction());
            out.residual = acting > 0 ? largest(r) / acting : 0;
            out.converged = largest(r) <= std::max(options.tolerance * acting, problem.rounding());
            if (out.converged || !std::isfinite(out.residual) || i == options.max_iterations)
                break;
            ++out.iterations;
            const VectorXd step = problem.direction(r);
            const double before = problem.potential(now), slope = step.dot(r);
            // Where the fall drowns in the energy's rounding, the force decides.
            const double noise = 1e-13 * (std::abs(before) + std::abs(now.dot(step)));
            double length = 1;
            problem.move(step, length);
            for (int half = 0; half < kHalvings; ++half) {
                const double fall = before - problem.potential(now);
                if (fall >= kDescent * length * slope || slope * length < noise)
                    break;
                problem.move(step, -length / 2);
                length /= 2;
            }
        }
        if (!out.converged)
            return out;
    }
    return out;
}

} // namespace ode::soft
