#include "modal/tall_product.h"

#include "modal/avx2.h"

#include <cassert>

namespace ode::soft {
namespace {

using Eigen::Index;

constexpr Index kWidth = 8;   ///< vectors in a block
constexpr Index kTile = 4;    ///< columns or rows of the basis held against it
constexpr Index kChunk = 256; ///< rows: 16 KB of the block stay in the first cache

/// sum[t][l] += v_t[i] y[i][l] over `rows` rows.
[[gnu::always_inline]] inline void dot_body(const double* v, Index stride, const double* y,
                                            Index rows, double* c) {
    double sum[kTile][kWidth] = {};
    for (Index i = 0; i < rows; ++i)
        for (Index t = 0; t < kTile; ++t)
            for (Index l = 0; l < kWidth; ++l)
                sum[t][l] += v[t * stride + i] * y[i * kWidth + l];
    for (Index t = 0; t < kTile; ++t)
        for (Index l = 0; l < kWidth; ++l)
            c[t * kWidth + l] += sum[t][l];
}

/// w[t][l] -= sum over k of v_k[t] c[k][l], for kTile rows t.
[[gnu::always_inline]] inline void update_body(const double* v, Index stride, const double* c,
                                               Index columns, double* w) {
    double sum[kTile][kWidth] = {};
    for (Index k = 0; k < columns; ++k)
        for (Index t = 0; t < kTile; ++t)
            for (Index l = 0; l < kWidth; ++l)
                sum[t][l] += v[k * stride + t] * c[k * kWidth + l];
    for (Index t = 0; t < kTile; ++t)
        for (Index l = 0; l < kWidth; ++l)
            w[t * kWidth + l] -= sum[t][l];
}

// The same arithmetic at either register width: equal bits.
using Kernel = void (*)(const double*, Index, const double*, Index, double*);
void dot_narrow(const double* v, Index stride, const double* y, Index rows, double* c) {
    dot_body(v, stride, y, rows, c);
}
ODE_SOFTBODY_AVX2 void dot_wide(const double* v, Index stride, const double* y, Index rows,
                                double* c) {
    dot_body(v, stride, y, rows, c);
}
void update_narrow(const double* v, Index stride, const double* c, Index columns, double* w) {
    update_body(v, stride, c, columns, w);
}
ODE_SOFTBODY_AVX2 void update_wide(const double* v, Index stride, const double* c, Index columns,
                                   double* w) {
    update_body(v, stride, c, columns, w);
}

} // namespace

Eigen::MatrixXd transpose_times(const Eigen::MatrixXd& v, Index columns, const RowMatrix& y) {
    assert(v.rows() == y.rows() && columns <= v.cols());
    if (y.cols() != kWidth)
        return v.leftCols(columns).transpose() * y;
    const Kernel dot = has_avx2() ? dot_wide : dot_narrow;
    RowMatrix c = RowMatrix::Zero(columns, kWidth);
    const Index whole = columns - columns % kTile;
    for (Index row = 0; row < v.rows(); row += kChunk) {
        const Index rows = std::min(kChunk, v.rows() - row);
        for (Index k = 0; k < whole; k += kTile)
            dot(v.data() + k * v.rows() + row, v.rows(), y.data() + row * kWidth, rows,
                c.data() + k * kWidth);
    }
    if (whole < columns)
        c.bottomRows(columns - whole).noalias() =
            v.middleCols(whole, columns - whole).transpose() * y;
    return c;
}

void subtract_times(const Eigen::MatrixXd& v, const Eigen::MatrixXd& c, RowMatrix& w) {
    assert(v.rows() == w.rows() && c.rows() <= v.cols());
    if (w.cols() != kWidth) {
        w.noalias() -= v.leftCols(c.rows()) * c;
        return;
    }
    const Kernel update = has_avx2() ? update_wide : update_narrow;
    const RowMatrix packed = c;
    const Index whole = v.rows() - v.rows() % kTile;
    // Columns by chunks, so that a page of the basis is read through before the next.
    for (Index k = 0; k < c.rows(); k += kChunk) {
        const Index columns = std::min(kChunk, c.rows() - k);
        for (Index row = 0; row < whole; row += kTile)
            update(v.data() + k * v.rows() + row, v.rows(), packed.data() + k * kWidth, columns,
                   w.data() + row * kWidth);
    }
    for (Index row = whole; row < v.rows(); ++row)
        w.row(row) -= v.row(row).head(c.rows()) * packed;
}

} // namespace ode::soft
