#pragma once

#include "integrate/node_state.h"
#include "model/elastic_model.h"

#include <Eigen/SparseCholesky>

#include <optional>

namespace ode::soft {

/// The equation that implicit methods solve, once or more a step: v = v* + c a(x* + c v, v), with
/// a = (load + material(x, v)) / m - alpha v. Held nodes keep their velocity.
///
/// The matrix M (1 + c alpha) + c C + c^2 K is factorised by Eigen's sparse LDL^T; its pattern is
/// analysed once. What the viscous force changes with position is left out of it: second order in
/// strain and rate, it costs Newton an iteration, never accuracy. What remains to be allocated in a
/// step is inside Eigen: a permuted copy of the matrix a factorisation, a vector a solution.
class ImplicitStage {
public:
    explicit ImplicitStage(std::size_t nodes);

    struct Equation {
        const ElasticModel& model;
        const NodeInertia& inertia;
        const NodeArray& load; ///< [N]
        double c;              ///< [s]
    };

    /// Newton's method with a line search on the residual in the norm of M^-1, to rounding.
    /// @param start    x* and v*.
    /// @param state    in: velocity to start from; out: the solution and x* + c v.
    /// @return the strain there, kFailedStep when no solution was found.
    StrainExtremes solve(const Equation& equation, const NodeState& start,
                         NodeState& state) noexcept;

    /// One linear solution about (x, v): v += (M (1 + c alpha) + c C + c^2 K)^-1
    /// c (force - M alpha v - c K v); then x += c v.
    /// @param force  all force at the state [N]
    /// @return whether there was one.
    bool solve_linearised(const Equation& equation, const NodeArray& force,
                          NodeState& state) noexcept;

private:
    bool factorise(const Equation& equation, const NodeArray& position) noexcept;
    /// residual_ = M (v* + c a - v) at the state. @return its squared norm in M^-1.
    double evaluate(const Equation& equation, const NodeState& start, const NodeState& state,
                    StrainExtremes& strain) noexcept;
    /// position = x* + c v.
    static void place(const NodeState& start, double c, NodeState& state) noexcept;

    std::optional<BlockMatrix> matrix_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
    NodeArray residual_, trial_;
    Eigen::VectorXd right_, step_;
};

} // namespace ode::soft
