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

template <typename Matrix>
void Transfer::up(const Matrix& coarse, Matrix& fine) const {
    fine.setZero(3 * static_cast<Index>(start_.size() - 1), coarse.cols());
    for (std::size_t i = 0; i + 1 < start_.size(); ++i)
        for (int t = start_[i]; t < start_[i + 1]; ++t) {
            const auto& [node, weight] = term_[static_cast<std::size_t>(t)];
            fine.middleRows(3 * static_cast<Index>(i), 3) +=
                static_cast<typename Matrix::Scalar>(weight) * coarse.middleRows(3 * node, 3);
        }
}

template <typename Matrix>
void Transfer::down(const Matrix& fine, Matrix& coarse) const {
    coarse.setZero(3 * coarse_nodes_, fine.cols());
    for (std::size_t i = 0; i + 1 < start_.size(); ++i)
        for (int t = start_[i]; t < start_[i + 1]; ++t) {
            const auto& [node, weight] = term_[static_cast<std::size_t>(t)];
            coarse.middleRows(3 * node, 3) += static_cast<typename Matrix::Scalar>(weight) *
                                              fine.middleRows(3 * static_cast<Index>(i), 3);
        }
}

template void Transfer::up(const RowMatrix&, RowMatrix&) const;
template void Transfer::up(const RowMatrixF&, RowMatrixF&) const;
template void Transfer::down(const RowMatrix&, RowMatrix&) const;
template void Transfer::down(const RowMatrixF&, RowMatrixF&) const;

TwoLevel::TwoLevel(const BlockSystem& fine, const Transfer& transfer, CoarseInverse coarse)
    : fine_(fine), transfer_(transfer), coarse_(std::move(coarse)), single_(fine) {
    inverse_block_.resize(fine.node_count());
    for (std::size_t i = 0; i < fine.node_count(); ++i)
        for (int p = fine.start[i]; p < fine.start[i + 1]; ++p)
            if (fine.column[static_cast<std::size_t>(p)] == static_cast<int>(i))
                inverse_block_[i] = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
                                        &fine.stiffness[9 * static_cast<std::size_t>(p)])
                                        .inverse()
                                        .cast<float>();
    // Power iteration: fifteen steps on one vector come within a few per cent from below.
    RowMatrixF x(fine.size(), 1), y, z;
    for (Index i = 0; i < x.rows(); ++i)
        x(i, 0) = static_cast<float>(std::sin(1.0 + 12.9898 * static_cast<double>(i)));
    for (int k = 0; k < 15; ++k) {
        x /= x.norm();
        single_.multiply(x, y);
        scale(y, z);
        high_ = 1.1 * static_cast<double>(z.norm());
        x = z;
    }
}

void TwoLevel::scale(const RowMatrixF& r, RowMatrixF& z) const {
    z.resize(r.rows(), r.cols());
    for (std::size_t i = 0; i < inverse_block_.size(); ++i) {
        const Eigen::Matrix3f& b = inverse_block_[i];
        const Index row = 3 * static_cast<Index>(i);
        for (Index k = 0; k < 3; ++k)
            z.row(row + k) =
                b(k, 0) * r.row(row) + b(k, 1) * r.row(row + 1) + b(k, 2) * r.row(row + 2);
    }
}

void TwoLevel::smooth(const RowMatrixF& r, RowMatrixF& z) const {
    const double theta = 0.5 * (1 + kLowShare) * high_, delta = 0.5 * (1 - kLowShare) * high_;
    scale(r, step_);
    step_ /= static_cast<float>(theta);
    z = step_;
    double rho = delta / theta;
    for (int k = 1; k < kDegree; ++k) {
        single_.multiply(z, residual_);
        residual_ = r - residual_;
        scale(residual_, scaled_);
        const double next = 1 / (2 * theta / delta - rho);
        step_ =
            static_cast<float>(next * rho) * step_ + static_cast<float>(2 * next / delta) * scaled_;
        z += step_;
        rho = next;
    }
}

void TwoLevel::cycle(const RowMatrixF& r, RowMatrixF& z) const {
    smooth(r, z);
    single_.multiply(z, rest_);
    rest_ = r - rest_;
    transfer_.down(rest_, low_);
    coarse_(low_);
    transfer_.up(low_, correction_);
    z += correction_;
    single_.multiply(z, rest_);
    rest_ = r - rest_;
    smooth(rest_, correction_);
    z += correction_;
}

int TwoLevel::solve(RowMatrix& r, RowMatrix& w, double share, int max_steps) const {
    const auto apply = [&] {
        right_ = r.cast<float>();
        cycle(right_, cycled_single_);
        cycled_ = cycled_single_.cast<double>();
    };
    w.setZero(r.rows(), r.cols());
    apply();
    direction_ = cycled_;
    RowVectorXd rz = r.cwiseProduct(cycled_).colwise().sum();
    RowVectorXd total = RowVectorXd::Zero(r.cols());
    for (int step = 1;; ++step) {
        multiply_stiffness(fine_, direction_, image_);
        const RowVectorXd curvature = direction_.cwiseProduct(image_).colwise().sum();
        // A column without residual stays: 0/0 becomes 0.
        const RowVectorXd alpha =
            (curvature.array() > 0).select(rz.array() / curvature.array(), 0.0).matrix();
        w.array() += direction_.array().rowwise() * alpha.array();
        const RowVectorXd gain = alpha.cwiseProduct(rz);
        total += gain;
        if (step == max_steps || (gain.array() <= share * total.array()).all())
            return step;
        r.array() -= image_.array().rowwise() * alpha.array();
        apply();
        const RowVectorXd next = r.cwiseProduct(cycled_).colwise().sum();
        const RowVectorXd beta = (rz.array() > 0).select(next.array() / rz.array(), 0.0).matrix();
        direction_ = (cycled_.array() + direction_.array().rowwise() * beta.array()).matrix();
        rz = next;
    }
}

} // namespace ode::soft
