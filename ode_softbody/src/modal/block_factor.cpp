#include "modal/block_factor.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using MatrixRef = Eigen::Ref<MatrixXd>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// L D L^T of a small dense block in place, lower triangle; D on the diagonal.
Index factor_diagonal(MatrixRef a) {
    Index negative = 0;
    const Index n = a.rows();
    for (Index k = 0; k < n; ++k) {
        double& d = a(k, k);
        const Index rest = n - k - 1;
        if (d == 0)
            d = 1e-300;
        negative += d < 0;
        const Eigen::VectorXd column = a.col(k).tail(rest);
        a.col(k).tail(rest) /= d;
        for (Index j = k + 1; j < n; ++j)
            a.col(j).tail(n - j) -= a(j, k) * column.tail(n - j);
    }
    return negative;
}

/// Eliminates the first `pivots` columns of the lower triangle of `a`.
/// @return negative pivots met.
Index factor_front(MatrixXd& a, Index pivots) {
    constexpr Index kPanel = 48;
    Index negative = 0;
    const Index n = a.rows();
    MatrixXd scaled;
    for (Index k = 0; k < pivots; k += kPanel) {
        const Index width = std::min(kPanel, pivots - k), rest = n - k - width;
        auto diagonal = a.block(k, k, width, width);
        negative += factor_diagonal(diagonal);
        if (rest == 0)
            continue;
        auto below = a.block(k + width, k, rest, width);
        diagonal.triangularView<Eigen::UnitLower>().transpose().solveInPlace<Eigen::OnTheRight>(
            below); // L D
        scaled = below;
        for (Index j = 0; j < width; ++j)
            below.col(j) /= diagonal(j, j); // L
        a.bottomRightCorner(rest, rest).triangularView<Eigen::Lower>() -=
            below * scaled.transpose();
    }
    return negative;
}

} // namespace

BlockFactor::BlockFactor(const BlockSystem& system) {
    Dissection dissection = dissect(system);
    order_ = std::move(dissection.order);
    position_.resize(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k)
        position_[at(order_[k])] = static_cast<int>(k);
    local_.assign(order_.size(), -1);
    front_.resize(dissection.piece.size());
    for (std::size_t f = 0; f < front_.size(); ++f) {
        const auto& piece = dissection.piece[f];
        Front& front = front_[f];
        front.first = piece.first;
        front.last = piece.last;
        auto& boundary = front.boundary; // children have merged theirs into it already
        for (int k = piece.first; k < piece.last; ++k) {
            const auto i = at(order_[at(k)]);
            for (int p = system.start[i]; p < system.start[i + 1]; ++p)
                boundary.push_back(position_[at(system.column[at(p)])]);
        }
        std::sort(boundary.begin(), boundary.end());
        boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
        boundary.erase(boundary.begin(),
                       std::lower_bound(boundary.begin(), boundary.end(), piece.last));
        boundary.shrink_to_fit();
        if (piece.parent >= 0) {
            Front& parent = front_[at(piece.parent)];
            parent.child.push_back(static_cast<int>(f));
            parent.boundary.insert(parent.boundary.end(), boundary.begin(), boundary.end());
        }
        const double own = 3.0 * (piece.last - piece.first);
        const double below = 3.0 * static_cast<double>(boundary.size());
        entries_ += own * (own + below);
        flops_ += own * own * own / 3 + own * own * below + own * below * below;
    }
}

MatrixXd BlockFactor::gather(const BlockSystem& system, double shift, const Front& front,
                             std::vector<MatrixXd>& update) const {
    const int own = front.last - front.first;
    for (int k = 0; k < own; ++k)
        local_[at(front.first + k)] = k;
    for (std::size_t k = 0; k < front.boundary.size(); ++k)
        local_[at(front.boundary[k])] = own + static_cast<int>(k);
    const Index size = 3 * (own + static_cast<Index>(front.boundary.size()));
    MatrixXd a = MatrixXd::Zero(size, size);
    for (int k = 0; k < own; ++k) {
        const auto i = at(order_[at(front.first + k)]);
        for (int p = system.start[i]; p < system.start[i + 1]; ++p) {
            const int to = position_[at(system.column[at(p)])];
            if (to < front.first + k)
                continue; // lower triangle: rows not before columns
            const double* block = &system.stiffness[9 * at(p)];
            const double m = shift * system.mass[at(p)];
            const Index row = 3 * local_[at(to)], column = 3 * k;
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c) // the pair (i, to) holds K(i, to) = K(to, i)^T
                    a(row + r, column + c) = block[3 * c + r] + (r == c ? m : 0.0);
        }
    }
    for (const int child : front.child) {
        const auto& nodes = front_[at(child)].boundary;
        MatrixXd& from = update[at(child)];
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            const Index column = 3 * local_[at(nodes[j])];
            for (int c = 0; c < 3; ++c) {
                const double* source = &from(0, 3 * static_cast<Index>(j) + c);
                double* target = &a(0, column + c);
                for (std::size_t i = j; i < nodes.size(); ++i) {
                    // Ascending positions stay ascending, own nodes before the boundary.
                    const Index row = 3 * local_[at(nodes[i])];
                    target[row] += source[3 * i];
                    target[row + 1] += source[3 * i + 1];
                    target[row + 2] += source[3 * i + 2];
                }
            }
        }
        from.resize(0, 0);
    }
    return a;
}

bool BlockFactor::factorise(const BlockSystem& system, double shift, bool keep,
                            const std::function<bool(double)>& progress) {
    std::vector<MatrixXd> update(front_.size());
    negative_pivots_ = 0;
    double done = 0;
    for (std::size_t f = 0; f < front_.size(); ++f) {
        Front& front = front_[f];
        MatrixXd a = gather(system, shift, front, update);
        const Index own = 3 * (front.last - front.first), below = a.rows() - own;
        negative_pivots_ += factor_front(a, own);
        if (below > 0)
            update[f] = a.bottomRightCorner(below, below);
        if (keep) {
            front.own = a.topLeftCorner(own, own);
            front.below = a.bottomLeftCorner(below, own);
        }
        const double n = static_cast<double>(own), m = static_cast<double>(below);
        done += n * n * n / 3 + n * n * m + n * m * m;
        if (progress && !progress(done / flops_))
            return false;
    }
    return true;
}

void BlockFactor::solve(RowMatrix& x) const {
    const Index vectors = x.cols();
    const auto nodes = static_cast<Index>(order_.size());
    assert(x.rows() == 3 * nodes);
    RowMatrix y(x.rows(), vectors);
    for (Index k = 0; k < nodes; ++k)
        y.middleRows(3 * k, 3) = x.middleRows(3 * order_[static_cast<std::size_t>(k)], 3);
    RowMatrix part;
    for (const Front& front : front_) {
        auto own = y.middleRows(3 * front.first, front.own.rows());
        if (own.rows() == 0)
            continue;
        front.own.triangularView<Eigen::UnitLower>().solveInPlace(own);
        part.noalias() = front.below * own;
        for (std::size_t k = 0; k < front.boundary.size(); ++k)
            y.middleRows(3 * front.boundary[k], 3) -= part.middleRows(3 * static_cast<Index>(k), 3);
    }
    for (auto front = front_.rbegin(); front != front_.rend(); ++front) {
        auto own = y.middleRows(3 * front->first, front->own.rows());
        if (own.rows() == 0)
            continue;
        for (Index r = 0; r < own.rows(); ++r)
            own.row(r) /= front->own(r, r);
        part.resize(front->below.rows(), vectors);
        for (std::size_t k = 0; k < front->boundary.size(); ++k)
            part.middleRows(3 * static_cast<Index>(k), 3) = y.middleRows(3 * front->boundary[k], 3);
        own.noalias() -= front->below.transpose() * part;
        front->own.triangularView<Eigen::UnitLower>().transpose().solveInPlace(own);
    }
    for (Index k = 0; k < nodes; ++k)
        x.middleRows(3 * order_[static_cast<std::size_t>(k)], 3) = y.middleRows(3 * k, 3);
}

// A front's part of the inverse follows from that of its boundary, which its parent has (K.
// Takahashi et al., Proc. 8th PICA Conf. (1973), 63): with W = L21 L11^-1
//     Z_bo = -Z_bb W,   Z_oo = (L11 D L11^T)^-1 - W^T Z_bo.
std::vector<Eigen::Matrix3d> BlockFactor::inverse_diagonal() const {
    std::vector<Eigen::Matrix3d> out(order_.size());
    std::vector<MatrixXd> known(front_.size()); // Z_bb, from the parent on
    MatrixXd w, z;
    for (std::size_t f = front_.size(); f-- > 0;) {
        const Front& front = front_[f];
        const Index own = front.own.rows(), below = 3 * static_cast<Index>(front.boundary.size());
        z.resize(own + below, own + below);
        z.bottomRightCorner(below, below) = known[f];
        known[f].resize(0, 0);
        const auto lower = front.own.triangularView<Eigen::UnitLower>();
        MatrixXd inverse = MatrixXd::Identity(own, own);
        lower.solveInPlace(inverse);
        w = front.below;
        if (below > 0)
            lower.solveInPlace<Eigen::OnTheRight>(w);
        z.bottomLeftCorner(below, own).noalias() = -z.bottomRightCorner(below, below) * w;
        z.topLeftCorner(own, own).noalias() =
            inverse.transpose() * front.own.diagonal().cwiseInverse().asDiagonal() * inverse;
        z.topLeftCorner(own, own).noalias() -= w.transpose() * z.bottomLeftCorner(below, own);
        z.topRightCorner(own, below) = z.bottomLeftCorner(below, own).transpose();
        for (Index k = 0; 3 * k < own; ++k)
            out[at(order_[at(front.first + static_cast<int>(k))])] = z.block<3, 3>(3 * k, 3 * k);

        for (int k = front.first; k < front.last; ++k)
            local_[at(k)] = k - front.first;
        for (std::size_t k = 0; k < front.boundary.size(); ++k)
            local_[at(front.boundary[k])] = front.last - front.first + static_cast<int>(k);
        for (const int child : front.child) {
            const auto& nodes = front_[at(child)].boundary;
            const auto size = static_cast<Index>(nodes.size());
            MatrixXd& to = known[at(child)];
            to.resize(3 * size, 3 * size);
            for (Index j = 0; j < size; ++j)
                for (Index i = 0; i < size; ++i)
                    to.block<3, 3>(3 * i, 3 * j) =
                        z.block<3, 3>(3 * local_[at(nodes[static_cast<std::size_t>(i)])],
                                      3 * local_[at(nodes[static_cast<std::size_t>(j)])]);
        }
    }
    return out;
}

} // namespace ode::soft
