#include "reduced/condense.h"

#include "reduced/pair_loads.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index index(std::size_t i) { return static_cast<Index>(i); }

/// What a load on the mesh's nodes moves, of all that is in none of the modes and no rigid motion.
/// @param by_mode  modes times load.
RowMatrix beyond_modes(const TetMesh& mesh, std::span<const Solid> solids,
                       const ModalOptions& options, const ModalModel& modes,
                       const Eigen::Map<const MatrixXd>& phi, const RowMatrix& load,
                       const MatrixXd& by_mode) {
    ModalProblem problem(mesh, solids, options);
    const std::vector<Index> row = problem.mesh_rows();
    // Large against what rounding leaves of free motions, small against what is left out.
    const double shift = eigenvalue_of(modes.frequency.front());
    BlockFactor factor(problem.system());
    factor.factorise(problem.system(), shift);
    const auto by_rows = [&](const auto& of_nodes) {
        RowMatrix x = RowMatrix::Zero(problem.system().size(), of_nodes.cols());
        for (std::size_t n = 0; n < row.size(); ++n)
            if (row[n] >= 0)
                x.middleRows<3>(row[n]) = of_nodes.template middleRows<3>(3 * index(n));
        return x;
    };
    RowMatrix x = by_rows(load);
    const RowMatrix& rigid = problem.rigid_motions();
    const MatrixXd by_rigid = rigid.transpose() * x;
    factor.solve(x);
    if (rigid.cols() > 0)
        x.noalias() -= rigid * (by_rigid / shift);
    MatrixXd share = by_mode;
    for (std::size_t k = 0; k < modes.mode_count(); ++k)
        share.row(index(k)) /= eigenvalue_of(modes.frequency[k]) + shift;
    x.noalias() -= by_rows(phi) * share;
    // Under the shift a mode at w answers by 1 / (w^2 + s): what that takes is given back but for
    // its square.
    RowMatrix y;
    multiply_mass(problem.system(), x, y);
    factor.solve(y);
    x += shift * y;
    RowMatrix out = RowMatrix::Zero(load.rows(), load.cols());
    for (std::size_t n = 0; n < row.size(); ++n)
        if (row[n] >= 0)
            out.middleRows<3>(3 * index(n)) = x.middleRows<3>(row[n]);
    return out;
}

/// The few shapes that hold most of what products of amplitudes move, products being as large as
/// modes of like energy make them.
void few_shapes(const ModalModel& modes, std::span<const double> mass, const RowMatrix& moved,
                std::size_t most, CubicTerms::Coefficients& out) {
    const Index pairs = moved.cols();
    VectorXd weight(pairs), frequency(pairs);
    for (std::size_t i = 0; i < out.order.modes; ++i)
        for (std::size_t j = i; j < out.order.modes; ++j) {
            const Index p = index(out.order.at(i, j));
            weight[p] = 1 / (modes.frequency[i] * modes.frequency[j]);
            frequency[p] = 2 * std::numbers::pi * (modes.frequency[i] + modes.frequency[j]);
        }
    VectorXd root(moved.rows());
    for (Index r = 0; r < root.size(); ++r)
        root[r] = std::sqrt(mass[static_cast<std::size_t>(r / 3)]);
    const RowMatrix scaled = root.asDiagonal() * moved * weight.asDiagonal();
    MatrixXd square = MatrixXd::Zero(pairs, pairs);
    square.selfadjointView<Eigen::Lower>().rankUpdate(scaled.transpose());
    const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(square); // reads the lower half
    const double all = parts.eigenvalues().sum();
    constexpr double kLeast = 1e-13; // of the square, above what rounding leaves
    std::size_t count = 0;
    while (count < std::min(most, static_cast<std::size_t>(pairs)) &&
           parts.eigenvalues()[pairs - 1 - index(count)] > kLeast * all)
        ++count;
    out.following.resize(index(count), pairs);
    for (std::size_t s = 0; s < count; ++s) {
        const VectorXd v = parts.eigenvectors().col(pairs - 1 - index(s));
        VectorXd shape = moved * weight.asDiagonal() * v;
        const double size = root.cwiseProduct(shape).norm();
        shape /= size;
        out.shape.insert(out.shape.end(), shape.begin(), shape.end());
        out.following.row(index(s)) = size * v.cwiseQuotient(weight).transpose();
        out.follow.push_back(v.cwiseAbs2().dot(frequency));
    }
}

} // namespace

CubicTerms::Coefficients condense(const TetMesh& mesh, std::span<const Solid> solids,
                                  const ModalOptions& options, const ModalModel& modes,
                                  std::span<const double> mass, const CubicExtent& extent) {
    CubicTerms::Coefficients out;
    const std::size_t kept = std::min(extent.kept, modes.mode_count());
    out.driven = std::min(extent.driven, modes.mode_count() - kept);
    PairLoads loads = pair_loads(mesh, solids, modes, kept);
    out.order = loads.order;
    const Eigen::Map<const MatrixXd> phi(modes.shape.data(), 3 * index(modes.node_count),
                                         index(modes.mode_count()));
    const MatrixXd by_mode = phi.transpose() * loads.load;
    out.cubic = by_mode.topRows(index(kept)) / 3;
    out.driving = by_mode.middleRows(index(kept), index(out.driven));
    RowMatrix moved = beyond_modes(mesh, solids, options, modes, phi, loads.load, by_mode);
    const Index first = index(kept + out.driven), left = by_mode.rows() - first;
    MatrixXd share = by_mode.bottomRows(left);
    for (Index k = 0; k < left; ++k)
        share.row(k) /= eigenvalue_of(modes.frequency[static_cast<std::size_t>(first + k)]);
    moved.noalias() += phi.rightCols(left) * share;
    MatrixXd gives_way(loads.load.cols(), loads.load.cols()); // symmetric: half of it is enough
    gives_way.triangularView<Eigen::Lower>() = loads.load.transpose() * moved;
    gives_way.triangularView<Eigen::StrictlyUpper>() = gives_way.transpose();
    out.quartic = loads.quartic - gives_way / 2;
    moved = -moved;
    few_shapes(modes, mass, moved, extent.following, out);
    return out;
}

} // namespace ode::soft
