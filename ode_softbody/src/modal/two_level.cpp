#include "modal/two_level.h"

#include <Eigen/LU>

#include <cmath>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::RowVectorXd;

/// Degree and range measured over a bar, a plate, a bowl, a block and a sphere: from degree 3 to 6
/// the CPU time differs by 30 %, and thin plates of wide elements want the higher ones.
constexpr int kDegree = 4;
/// The smoother works on the upper part of the spectrum, down to this share of its top; below lies
/// what the coarse order represents.
constexpr double kLowShare = 1.0 / 20;

} // namespace

Transfer::Transfer(const DofMap& coarse, const std::vector<char>& coarse_held, const DofMap& fine,
                   const std::vector<char>& fine_held) {
    std::vector<int> index(coarse.node_count(), -1);
    int next = 0;
    for (std::size_t i = 0; i < index.size(); ++i)
        if (coarse_held[i] != 7)
            index[i] = next++;
    coarse_nodes_ = next;
    const Prolongation all = prolongate(coarse, fine);
    start_.push_back(0);
    for (std::size_t i = 0; i < fine.node_count(); ++i) {
        if (fine_held[i] == 7)
            continue;
        for (int t = all.start[i]; t < all.start[i + 1]; ++t) {
            const auto& [node, weight] = all.term[static_cast<std::size_t>(t)];
            if (const int k = index[static_cast<std::size_t>(node)]; k >= 0)
                term_.push_back({k, weight});
        }
        start_.push_back(static_cast<int>(term_.size()));
    }
}

void Transfer::up(const RowMatrix& coarse, RowMatrix& fine) const {
    fine.setZero(3 * static_cast<Index>(start_.size() - 1), coarse.cols());
    for (std::size_t i = 0; i + 1 < start_.size(); ++i)
        for (int t = start_[i]; t < start_[i + 1]; ++t) {
            const auto& [node, weight] = term_[static_cast<std::size_t>(t)];
            fine.middleRows(3 * static_cast<Index>(i), 3) +=
                weight * coarse.middleRows(3 * node, 3);
        }
}

void Transfer::down(const RowMatrix& fine, RowMatrix& coarse) const {
    coarse.setZero(3 * coarse_nodes_, fine.cols());
    for (std::size_t i = 0; i + 1 < start_.size(); ++i)
        for (int t = start_[i]; t < start_[i + 1]; ++t) {
            const auto& [node, weight] = term_[static_cast<std::size_t>(t)];
            coarse.middleRows(3 * node, 3) +=
                weight * fine.middleRows(3 * static_cast<Index>(i), 3);
        }
}

TwoLevel::TwoLevel(const BlockSystem& fine, const BlockFactor& coarse, const Transfer& transfer)
    : fine_(fine), coarse_(coarse), transfer_(transfer) {
    inverse_block_.resize(fine.node_count());
    for (std::size_t i = 0; i < fine.node_count(); ++i)
        for (int p = fine.start[i]; p < fine.start[i + 1]; ++p)
            if (fine.column[static_cast<std::size_t>(p)] == static_cast<int>(i))
                inverse_block_[i] = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
                                        &fine.stiffness[9 * static_cast<std::size_t>(p)])
                                        .inverse();
    // Power iteration: fifteen steps on one vector come within a few per cent from below.
    RowMatrix x(fine.size(), 1), y, z;
    for (Index i = 0; i < x.rows(); ++i)
        x(i, 0) = std::sin(1.0 + 12.9898 * static_cast<double>(i));
    for (int k = 0; k < 15; ++k) {
        x /= x.norm();
        multiply_stiffness(fine, x, y);
        scale(y, z);
        high_ = 1.1 * z.norm();
        x = z;
    }
}

void TwoLevel::scale(const RowMatrix& r, RowMatrix& z) const {
    z.resize(r.rows(), r.cols());
    for (std::size_t i = 0; i < inverse_block_.size(); ++i) {
        const Mat3& b = inverse_block_[i];
        const Index row = 3 * static_cast<Index>(i);
        for (Index k = 0; k < 3; ++k)
            z.row(row + k) =
                b(k, 0) * r.row(row) + b(k, 1) * r.row(row + 1) + b(k, 2) * r.row(row + 2);
    }
}

void TwoLevel::smooth(const RowMatrix& r, RowMatrix& z) const {
    const double theta = 0.5 * (1 + kLowShare) * high_, delta = 0.5 * (1 - kLowShare) * high_;
    scale(r, step_);
    step_ /= theta;
    z = step_;
    double rho = delta / theta;
    for (int k = 1; k < kDegree; ++k) {
        multiply_stiffness(fine_, z, residual_);
        residual_ = r - residual_;
        scale(residual_, scaled_);
        const double next = 1 / (2 * theta / delta - rho);
        step_ = next * rho * step_ + 2 * next / delta * scaled_;
        z += step_;
        rho = next;
    }
}

void TwoLevel::precondition(const RowMatrix& r, RowMatrix& z) const {
    smooth(r, z);
    RowMatrix rest;
    multiply_stiffness(fine_, z, rest);
    rest = r - rest;
    transfer_.down(rest, low_);
    coarse_.solve(low_);
    transfer_.up(low_, correction_);
    z += correction_;
    multiply_stiffness(fine_, z, rest);
    rest = r - rest;
    smooth(rest, correction_);
    z += correction_;
}

int TwoLevel::solve(RowMatrix& r, RowMatrix& w, double share, int max_steps) const {
    w.setZero(r.rows(), r.cols());
    RowMatrix z, p, q;
    precondition(r, z);
    p = z;
    RowVectorXd rz = r.cwiseProduct(z).colwise().sum();
    RowVectorXd total = RowVectorXd::Zero(r.cols());
    for (int step = 1;; ++step) {
        multiply_stiffness(fine_, p, q);
        const RowVectorXd curvature = p.cwiseProduct(q).colwise().sum();
        // A column without residual stays: 0/0 becomes 0.
        const RowVectorXd alpha =
            (curvature.array() > 0).select(rz.array() / curvature.array(), 0.0).matrix();
        w.array() += p.array().rowwise() * alpha.array();
        r.array() -= q.array().rowwise() * alpha.array();
        const RowVectorXd gain = alpha.cwiseProduct(rz);
        total += gain;
        if (step == max_steps || (gain.array() <= share * total.array()).all())
            return step;
        precondition(r, z);
        const RowVectorXd next = r.cwiseProduct(z).colwise().sum();
        const RowVectorXd beta = (rz.array() > 0).select(next.array() / rz.array(), 0.0).matrix();
        p = (z.array() + p.array().rowwise() * beta.array()).matrix();
        rz = next;
    }
}

} // namespace ode::soft
