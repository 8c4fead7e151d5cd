#include "modal/refine.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Columns worked on at once: the vectors of a batch, and not of all modes, are held some twelve
/// times. Fewer of long ones, for half a GiB.
Index batch_of(Index length) {
    const auto affordable = static_cast<Index>(0x1p29 / (12.0 * 8 * static_cast<double>(length)));
    return std::clamp<Index>(8 * (affordable / 8), 8, 32);
}

/// Gram matrices of [P X, W]: kept as blocks because P X is never stored as a whole.
struct Gram {
    MatrixXd xx, xw, ww;
    explicit Gram(Index m) : xx(m, m), xw(m, m), ww(m, m) {}
    MatrixXd whole() const {
        const Index m = xx.rows();
        MatrixXd g(2 * m, 2 * m);
        g << xx, xw, xw.transpose(), ww;
        return 0.5 * (g + g.transpose());
    }
};

} // namespace

Refined refine(const EigenPairs& pairs, const Transfer& transfer, const ModalProblem& fine,
               const TwoLevel& inverse, Effort effort,
               const std::function<void(double)>& progress) {
    const BlockSystem& system = fine.system();
    const Index m = pairs.value.size();
    Refined out;
    if (m == 0)
        return out;
    const Index batch = batch_of(system.size());
    const RowMatrix& rigid = fine.rigid_motions();
    Gram stiffness(m), mass(m);
    out.correction.resize(system.size(), m);
    RowMatrix x, kx, mx, low, w;
    for (Index first = 0; first < m; first += batch) {
        const Index width = std::min(batch, m - first);
        low = pairs.vector.middleCols(first, width);
        transfer.up(low, x);
        multiply_stiffness(system, x, kx);
        multiply_mass(system, x, mx);
        transfer.down(kx, low);
        stiffness.xx.middleCols(first, width).noalias() = pairs.vector.transpose() * low;
        transfer.down(mx, low);
        mass.xx.middleCols(first, width).noalias() = pairs.vector.transpose() * low;
        // Residual by the Rayleigh quotient on the fine order: a lumped coarse mass fits too.
        const Eigen::RowVectorXd quotient =
            x.cwiseProduct(kx).colwise().sum().cwiseQuotient(x.cwiseProduct(mx).colwise().sum());
        RowMatrix r = mx.array().rowwise() * quotient.array() - kx.array();
        out.steps = std::max(out.steps, inverse.solve(r, w, effort.share, effort.steps));
        if (rigid.cols() > 0) {
            multiply_mass(system, w, mx);
            w.noalias() -= rigid * (rigid.transpose() * mx).eval();
        }
        multiply_mass(system, w, mx);
        // Unit mass, so that the Gram matrix is well scaled.
        Eigen::RowVectorXd length = w.cwiseProduct(mx).colwise().sum().cwiseSqrt();
        length = (length.array() > 0).select(length, 1.0);
        out.correction.middleCols(first, width) = w.array().rowwise() / length.array();
        if (progress)
            progress(static_cast<double>(first + width) / static_cast<double>(m));
    }
    for (Index first = 0; first < m; first += batch) {
        const Index width = std::min(batch, m - first);
        w = out.correction.middleCols(first, width);
        multiply_stiffness(system, w, kx);
        multiply_mass(system, w, mx);
        transfer.down(kx, low);
        stiffness.xw.middleCols(first, width).noalias() = pairs.vector.transpose() * low;
        transfer.down(mx, low);
        mass.xw.middleCols(first, width).noalias() = pairs.vector.transpose() * low;
        // Symmetric: the rows from this batch on are enough.
        stiffness.ww.block(first, first, m - first, width).noalias() =
            out.correction.rightCols(m - first).transpose() * kx;
        mass.ww.block(first, first, m - first, width).noalias() =
            out.correction.rightCols(m - first).transpose() * mx;
    }
    stiffness.ww.triangularView<Eigen::StrictlyUpper>() =
        stiffness.ww.transpose().triangularView<Eigen::StrictlyUpper>();
    mass.ww.triangularView<Eigen::StrictlyUpper>() =
        mass.ww.transpose().triangularView<Eigen::StrictlyUpper>();

    // Directions that W repeats are dropped: below 1e-10 of unit mass they are rounding.
    const MatrixXd big_m = mass.whole(), big_k = stiffness.whole();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> metric(big_m);
    const Index dropped = (metric.eigenvalues().array() < 1e-10).count();
    const Index kept = 2 * m - dropped;
    const MatrixXd basis = metric.eigenvectors().rightCols(kept) *
                           metric.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
    const MatrixXd projected = basis.transpose() * big_k * basis;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(projected);
    out.value = ritz.eigenvalues().head(m);
    const MatrixXd c = basis * ritz.eigenvectors().leftCols(m);
    out.from = c.topRows(m);
    out.along = c.bottomRows(m);
    return out;
}

} // namespace ode::soft
