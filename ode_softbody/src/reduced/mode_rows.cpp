#include "reduced/mode_rows.h"

#include "modal/avx2.h"

#include <algorithm>
#include <cstring>

namespace ode::soft {
namespace {

static_assert(ModalBasis::kLanes == 8);
typedef float Lanes __attribute__((vector_size(32))); // two registers where there is no AVX

/// The three numbers of a node: its rows times q.
[[gnu::always_inline]] inline void expand_body(const float* row, std::size_t columns,
                                               const float* q, double* out) {
    // Rows and q begin at whole registers.
    const std::size_t registers = columns / ModalBasis::kLanes;
    const auto* const own = reinterpret_cast<const Lanes*>(row);
    const auto* const amplitude = reinterpret_cast<const Lanes*>(q);
    Lanes sum[3] = {};
    for (std::size_t k = 0; k < registers; ++k) {
        sum[0] += own[k] * amplitude[k];
        sum[1] += own[registers + k] * amplitude[k];
        sum[2] += own[2 * registers + k] * amplitude[k];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float s[ModalBasis::kLanes];
        std::memcpy(s, &sum[axis], sizeof s);
        out[axis] =
            static_cast<double>(((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7])));
    }
}

[[gnu::always_inline]] inline void project_body(const float* row, std::size_t columns,
                                                const double* f, double* q) {
    for (std::size_t k = 0; k < columns; ++k)
        q[k] += static_cast<double>(row[k]) * f[0] + static_cast<double>(row[columns + k]) * f[1] +
                static_cast<double>(row[2 * columns + k]) * f[2];
}

// The same arithmetic at either register width: equal bits.
void expand_narrow(const float* row, std::size_t columns, const float* q, double* out) {
    expand_body(row, columns, q, out);
}
ODE_SOFTBODY_AVX2 void expand_wide(const float* row, std::size_t columns, const float* q,
                                   double* out) {
    expand_body(row, columns, q, out);
}
void project_narrow(const float* row, std::size_t columns, const double* f, double* q) {
    project_body(row, columns, f, q);
}
ODE_SOFTBODY_AVX2 void project_wide(const float* row, std::size_t columns, const double* f,
                                    double* q) {
    project_body(row, columns, f, q);
}

} // namespace

void project(const ModalBasis& basis, std::size_t node, const Vec3& f,
             std::span<double> q) noexcept {
    (has_avx2() ? project_wide : project_narrow)(basis.row(node, 0), basis.columns, f.data(),
                                                 q.data());
}

Spread::Spread(const ModalBasis& basis, std::span<const double> q,
               std::span<float> scratch) noexcept
    : basis_(basis), q_(scratch.data()), expand_(has_avx2() ? expand_wide : expand_narrow) {
    std::transform(q.begin(), q.end(), scratch.begin(),
                   [](double x) { return static_cast<float>(x); });
}

} // namespace ode::soft
