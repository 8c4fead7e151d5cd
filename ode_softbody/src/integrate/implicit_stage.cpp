#include "integrate/implicit_stage.h"

#include "integrate/integrator.h"
#include "integrate/stage.h"

#include <cmath>

namespace ode::soft {
namespace {

using Eigen::Index;

constexpr int kMostIterations = 40;
constexpr int kMostHalvings = 12;
/// Of the velocity that the step changes. Newton's error is then its square.
constexpr double kSmallChange = 1e-8;
/// Of the body's extent: below, a change of place is rounding of world coordinates.
constexpr double kRounding = 1e-14;

Index first_row(std::size_t node) noexcept { return 3 * static_cast<Index>(node); }

double extent_of(const NodeArray& x) noexcept {
    Vec3 low = x[0], high = x[0];
    for (std::size_t i = 1; i < x.size(); ++i) {
        low = low.cwiseMin(x[i]);
        high = high.cwiseMax(x[i]);
    }
    return std::max((high - low).norm(), high.cwiseAbs().maxCoeff());
}

} // namespace

ImplicitStage::ImplicitStage(std::size_t nodes)
    : residual_(nodes), trial_(nodes), right_(3 * static_cast<Index>(nodes)) {}

bool ImplicitStage::factorise(const Equation& eq, const NodeArray& position) noexcept {
    const bool fresh = !matrix_;
    if (fresh)
        matrix_.emplace(eq.model.tangent_pattern());
    matrix_->set_zero();
    eq.model.add_tangent(position, eq.c * eq.c, eq.c, *matrix_);
    const std::span<const double> mass = eq.model.mass();
    for (std::size_t i = 0; i < mass.size(); ++i)
        matrix_->add(static_cast<int>(i), static_cast<int>(i),
                     mass[i] * (1 + eq.c * eq.inertia.alpha) * Mat3::Identity());
    Eigen::SparseMatrix<double>& a = matrix_->matrix();
    const auto held = [&](Index row) {
        return eq.inertia.inverse_mass[static_cast<std::size_t>(row / 3)] == 0;
    };
    for (Index column = 0; column < a.cols(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator it(a, column); it; ++it)
            if (held(column) || held(it.row()))
                it.valueRef() = it.row() == column ? 1.0 : 0.0;
    if (fresh)
        factor_.analyzePattern(a);
    factor_.factorize(a);
    return factor_.info() == Eigen::Success;
}

double ImplicitStage::evaluate(const Equation& eq, const NodeState& start, const NodeState& state,
                               StrainExtremes& strain) noexcept {
    std::copy_n(eq.load.data(), NodeArray::kStride * eq.load.size(), residual_.data());
    strain = eq.model.add_force(state.position, state.velocity, residual_);
    const std::span<const double> mass = eq.model.mass();
    double sum = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) {
        auto r = residual_[i];
        if (eq.inertia.inverse_mass[i] == 0) {
            r.setZero();
            continue;
        }
        r = eq.c * r +
            mass[i] * (start.velocity[i] - (1 + eq.c * eq.inertia.alpha) * state.velocity[i]);
        sum += r.squaredNorm() * eq.inertia.inverse_mass[i];
    }
    return sum;
}

void ImplicitStage::place(const NodeState& start, double c, NodeState& state) noexcept {
    const std::size_t n = NodeArray::kStride * state.position.size();
    for (std::size_t i = 0; i < n; ++i)
        state.position.data()[i] = start.position.data()[i] + c * state.velocity.data()[i];
}

StrainExtremes ImplicitStage::solve(const Equation& eq, const NodeState& start,
                                    NodeState& state) noexcept {
    const std::size_t nodes = start.position.size();
    const double extent = extent_of(start.position);
    StrainExtremes strain;
    place(start, eq.c, state);
    double norm = evaluate(eq, start, state, strain);
    for (int iteration = 0; iteration < kMostIterations; ++iteration) {
        if (!std::isfinite(norm) || !factorise(eq, state.position))
            return kFailedStep;
        for (std::size_t i = 0; i < nodes; ++i)
            right_.segment<3>(first_row(i)) = residual_[i];
        step_ = factor_.solve(right_);
        double largest = 0, change = 0;
        for (std::size_t i = 0; i < nodes; ++i) {
            largest = std::max(largest, step_.segment<3>(first_row(i)).norm());
            change = std::max(change, (state.velocity[i] - start.velocity[i]).norm());
        }
        const bool last = largest <= kSmallChange * change || largest * eq.c <= kRounding * extent;
        // Halved until the residual falls; close to the solution rounding may keep it from falling.
        std::copy_n(state.velocity.data(), NodeArray::kStride * nodes, trial_.data());
        double share = 1, next = 0;
        for (int halving = 0; halving <= kMostHalvings; ++halving, share /= 2) {
            for (std::size_t i = 0; i < nodes; ++i)
                state.velocity[i] = trial_[i] + share * step_.segment<3>(first_row(i));
            place(start, eq.c, state);
            next = evaluate(eq, start, state, strain);
            if (last || next <= (1 - 1e-4 * share) * norm)
                break;
        }
        if (last)
            return strain;
        if (!(next < norm))
            return kFailedStep;
        norm = next;
    }
    return kFailedStep;
}

bool ImplicitStage::solve_linearised(const Equation& eq, const NodeArray& force,
                                     NodeState& state) noexcept {
    if (!factorise(eq, state.position))
        return false;
    BlockMatrix& stiffness = *matrix_; // the factor has no more need of it
    stiffness.set_zero();
    eq.model.add_tangent(state.position, 1, 0, stiffness);
    const std::size_t nodes = force.size();
    for (std::size_t i = 0; i < nodes; ++i)
        right_.segment<3>(first_row(i)) = state.velocity[i];
    step_.noalias() = stiffness.matrix() * right_;
    const std::span<const double> mass = eq.model.mass();
    for (std::size_t i = 0; i < nodes; ++i) {
        auto r = right_.segment<3>(first_row(i));
        if (eq.inertia.inverse_mass[i] == 0)
            r.setZero();
        else
            r = eq.c * (force[i] - mass[i] * eq.inertia.alpha * state.velocity[i] -
                        eq.c * step_.segment<3>(first_row(i)));
    }
    step_ = factor_.solve(right_);
    for (std::size_t i = 0; i < nodes; ++i)
        state.velocity[i] += step_.segment<3>(first_row(i));
    add_scaled(state.position, eq.c, state.velocity);
    return step_.allFinite();
}

} // namespace ode::soft
