#include "modal/block_lanczos.h"

#include "modal/tall_product.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kBlock = 8;

/// Numbers in [-1, 1) that are the same everywhere (SplitMix64, Steele et al. 2014).
RowMatrix random_block(Index rows, Index columns, std::uint64_t seed) {
    RowMatrix out(rows, columns);
    std::uint64_t state = seed * 0x9E3779B97F4A7C15u;
    for (Index i = 0; i < out.size(); ++i) {
        std::uint64_t z = (state += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        z ^= z >> 31;
        out.data()[i] = static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
    }
    return out;
}

class Lanczos {
public:
    Lanczos(const BlockSystem& system, const BlockFactor& factor, double shift,
            const RowMatrix& deflated, const LanczosOptions& options, unsigned seed)
        : system_(system), factor_(factor), shift_(shift), deflated_(deflated), options_(options) {
        const Index size = system.size() - deflated.cols();
        const auto affordable = static_cast<Index>(
            options.basis_bytes / (sizeof(double) * static_cast<std::size_t>(system.size() + 1)));
        capacity_ = std::min(size, std::max<Index>(affordable, 8 * kBlock));
        wanted_limit_ = capacity_ == size ? size : (3 * capacity_) / 5;
        if (options.max_pairs > 0)
            wanted_limit_ = std::min(wanted_limit_, options.max_pairs);
        next_ = random_block(system.size(), std::min(kBlock, size), seed);
        // One multiplication by the operator first: it damps what no one asks for.
        RowMatrix image;
        multiply_mass(system_, next_, image);
        factor_.solve(image);
        next_ = image;
        project(next_, nullptr);
        coupling_ = orthonormalise(next_, 0.0);
    }

    EigenPairs run() {
        EigenPairs out;
        Index check_at = 4 * kBlock;
        for (;;) {
            append();
            ++out.steps;
            const bool exhausted = next_.cols() == 0 || size_ + next_.cols() > capacity_;
            if (size_ >= check_at || exhausted) {
                check_at = size_ + std::max(2 * kBlock, size_ / 6);
                if (assess() || next_.cols() == 0 || size_ == system_.size() - deflated_.cols())
                    break;
                if (exhausted)
                    restart();
            }
        }
        extract(out);
        return out;
    }

private:
    /// w -= Q (Q^T M w) for the basis and the deflated vectors; h gets the basis coefficients.
    void project(RowMatrix& w, MatrixXd* h) {
        multiply_mass(system_, w, image_);
        if (deflated_.cols() > 0)
            w.noalias() -= deflated_ * (deflated_.transpose() * image_).eval();
        if (size_ == 0)
            return;
        const MatrixXd c = transpose_times(basis_, size_, image_);
        subtract_times(basis_, c, w);
        if (h)
            *h += c;
    }

    /// Mass-orthonormal basis of the columns of w, which are orthogonal to everything known up to
    /// rounding; columns shorter than `floor` go. Normalising magnifies what rounding left, so the
    /// projection is repeated until nothing is.
    /// @return R with w_before = w_after R.
    MatrixXd orthonormalise(RowMatrix& w, double floor) {
        MatrixXd r = MatrixXd::Identity(w.cols(), w.cols());
        for (int pass = 0; pass < 4; ++pass) {
            if (pass > 0)
                project(w, nullptr);
            multiply_mass(system_, w, image_);
            const MatrixXd gram = w.transpose() * image_;
            if (pass > 0 && (gram - MatrixXd::Identity(w.cols(), w.cols())).norm() < 1e-13)
                break;
            const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
            Index drop = 0;
            while (drop < gram.cols() && !(eigen.eigenvalues()[drop] > floor * floor))
                ++drop;
            const Index keep = gram.cols() - drop;
            const VectorXd root = eigen.eigenvalues().tail(keep).cwiseSqrt();
            const MatrixXd q = eigen.eigenvectors().rightCols(keep);
            w = (w * (q * root.cwiseInverse().asDiagonal())).eval();
            r = (root.asDiagonal() * q.transpose() * r).eval();
            floor = 0.5; // a column that shrinks that much again was rounding
        }
        return r;
    }

    void append() {
        const Index width = next_.cols();
        if (basis_.cols() < size_ + width) {
            const Index columns =
                std::min(capacity_, std::max<Index>(2 * basis_.cols(), 16 * kBlock));
            basis_.conservativeResize(system_.size(), columns);
            h_.conservativeResize(columns, columns);
        }
        basis_.middleCols(size_, width) = next_;
        RowMatrix w;
        multiply_mass(system_, next_, w);
        factor_.solve(w);
        const Index first = size_;
        size_ += width;
        MatrixXd h = MatrixXd::Zero(size_, width);
        project(w, &h);
        project(w, &h);
        h_.block(0, first, size_, width) = h;
        h_.block(first, 0, width, size_) = h.transpose();
        h_.block(first, first, width, width) =
            0.5 * (h.bottomRows(width) + h.bottomRows(width).transpose());
        next_ = std::move(w);
        if (size_ == system_.size() - deflated_.cols())
            next_.resize(system_.size(), 0);
        const double floor = 1e-12 * h_.topLeftCorner(size_, size_).diagonal().maxCoeff();
        coupling_ = next_.cols() > 0 ? orthonormalise(next_, floor) : MatrixXd::Zero(0, width);
        last_width_ = width;
    }

    /// Ritz values and residuals. @return true when all that is wanted has converged.
    bool assess() {
        ritz_.compute(h_.topLeftCorner(size_, size_));
        const VectorXd& theta = ritz_.eigenvalues(); // ascending: the wanted ones last
        const auto residual = [&](Index i) {
            return (coupling_ * ritz_.eigenvectors().col(i).tail(last_width_)).norm();
        };
        wanted_ = 0;
        converged_ = 0;
        bool unbroken = true;
        for (Index i = size_ - 1; i >= 0 && wanted_ < wanted_limit_; --i) {
            if (!(theta[i] > 0) || 1 / theta[i] - shift_ > options_.upper)
                break;
            ++wanted_;
            unbroken = unbroken && residual(i) <= options_.tolerance * theta[i];
            converged_ += unbroken;
        }
        // The next pair beyond shows, to a per cent, that the band ends where it seems to.
        const Index next = size_ - 1 - wanted_;
        const bool closed =
            next_.cols() == 0 || (next >= 0 && residual(next) <= 1e-2 * theta[next]);
        if (options_.progress &&
            !options_.progress(converged_, wanted_ ? static_cast<double>(converged_) /
                                                         static_cast<double>(wanted_)
                                                   : 0.0))
            throw Cancelled{};
        return closed && converged_ == wanted_;
    }

    /// Keeps the best Ritz vectors; the next block still continues their recurrence, because
    /// append() computes its coupling to every one of them.
    void restart() {
        const Index keep = std::min<Index>(std::max(wanted_ + wanted_ / 4 + 2 * kBlock, size_ / 2),
                                           size_ - 2 * kBlock);
        const MatrixXd s = ritz_.eigenvectors().rightCols(keep);
        constexpr Index kRows = 4096;
        for (Index row = 0; row < basis_.rows(); row += kRows) {
            const Index rows = std::min(kRows, basis_.rows() - row);
            basis_.block(row, 0, rows, keep) = (basis_.block(row, 0, rows, size_) * s).eval();
        }
        h_.topLeftCorner(keep, keep) = ritz_.eigenvalues().tail(keep).asDiagonal();
        size_ = keep;
    }

    void extract(EigenPairs& out) {
        const VectorXd& theta = ritz_.eigenvalues();
        const auto lambda = [&](Index k) { return 1 / theta[size_ - 1 - k] - shift_; };
        const Index count = wanted_;
        out.value.resize(count);
        const MatrixXd s = ritz_.eigenvectors().rightCols(count).rowwise().reverse();
        out.vector = basis_.leftCols(size_) * s;
        for (Index k = 0; k < count; ++k)
            out.value[k] = lambda(k);
        const bool more = count < size_ && theta[size_ - 1 - count] > 0;
        out.beyond = more ? lambda(count) : 2 * (count ? lambda(count - 1) : options_.upper);
        out.complete = !(more && out.beyond <= options_.upper);
    }

    const BlockSystem& system_;
    const BlockFactor& factor_;
    double shift_;
    const RowMatrix& deflated_;
    const LanczosOptions& options_;
    Index capacity_, wanted_limit_;
    MatrixXd basis_, h_, coupling_;
    RowMatrix next_, image_;
    Index size_ = 0, last_width_ = 0, wanted_ = 0, converged_ = 0;
    Eigen::SelfAdjointEigenSolver<MatrixXd> ritz_;
};

} // namespace

EigenPairs lowest_pairs(const BlockSystem& system, const BlockFactor& factor, double shift,
                        const RowMatrix& deflated, const LanczosOptions& options, unsigned seed) {
    return Lanczos(system, factor, shift, deflated, options, seed).run();
}

} // namespace ode::soft
