#include "model/block_matrix.h"

#include <algorithm>

namespace ode::soft {

BlockMatrix::BlockMatrix(std::span<const int> element, int corners, std::size_t nodes)
    : first_(nodes + 1, 0) {
    const auto n = static_cast<std::size_t>(corners);
    std::vector<std::size_t> use_first(nodes + 1, 0);
    for (const int node : element)
        ++use_first[static_cast<std::size_t>(node) + 1];
    for (std::size_t i = 0; i < nodes; ++i)
        use_first[i + 1] += use_first[i];
    std::vector<std::size_t> use(element.size()), fill(use_first);
    for (std::size_t i = 0; i < element.size(); ++i)
        use[fill[static_cast<std::size_t>(element[i])]++] = i / n;

    std::vector<int> near;
    for (std::size_t i = 0; i < nodes; ++i) {
        near.assign(1, static_cast<int>(i));
        for (std::size_t u = use_first[i]; u < use_first[i + 1]; ++u)
            for (const int other : element.subspan(use[u] * n, n))
                near.push_back(other);
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        neighbour_.insert(neighbour_.end(), near.begin(), near.end());
        first_[i + 1] = static_cast<int>(neighbour_.size());
    }

    const auto size = static_cast<Eigen::Index>(3 * nodes);
    matrix_.resize(size, size);
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(9 * neighbour_.size()));
    int* outer = matrix_.outerIndexPtr();
    int* inner = matrix_.innerIndexPtr();
    int at = 0;
    for (std::size_t i = 0; i < nodes; ++i)
        for (int c = 0; c < 3; ++c) {
            *outer++ = at;
            for (int k = first_[i]; k < first_[i + 1]; ++k)
                for (int r = 0; r < 3; ++r)
                    inner[at++] = 3 * neighbour_[static_cast<std::size_t>(k)] + r;
        }
    *outer = at;
    set_zero();
}

void BlockMatrix::set_zero() noexcept { std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0); }

void BlockMatrix::add(int row, int column, const Mat3& block) noexcept {
    const auto begin = neighbour_.begin() + first_[static_cast<std::size_t>(column)];
    const auto end = neighbour_.begin() + first_[static_cast<std::size_t>(column) + 1];
    const auto rank = 3 * (std::lower_bound(begin, end, row) - begin);
    for (int c = 0; c < 3; ++c) {
        double* at = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * column + c] + rank;
        for (int r = 0; r < 3; ++r)
            at[r] += block(r, c);
    }
}

} // namespace ode::soft
