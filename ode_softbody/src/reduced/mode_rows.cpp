#include "reduced/mode_rows.h"

#include "modal/avx2.h"

#include <algorithm>
#include <cstring>

namespace ode::soft {
namespace {

static_assert(ModalBasis::kLanes == 8);
typedef float Lanes __attribute__((vector_size(32))); // two registers where there is no AVX

[[gnu::always_inline]] inline double total(const Lanes& lanes) {
    float s[ModalBasis::kLanes];
    std::memcpy(s, &lanes, sizeof s);
    return static_cast<double>(((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7])));
}

// Of `stride` columns a row has, the first `columns` are used: whole registers.

/// The three numbers of a node: its rows times q.
[[gnu::always_inline]] inline void expand_body(const float* row, std::size_t stride,
                                               std::size_t columns, const float* q, double* out) {
    const std::size_t registers = columns / ModalBasis::kLanes;
    const std::size_t next = stride / ModalBasis::kLanes;
    const auto* const own = reinterpret_cast<const Lanes*>(row);
    const auto* const amplitude = reinterpret_cast<const Lanes*>(q);
    Lanes sum[3] = {};
    for (std::size_t k = 0; k < registers; ++k) {
        sum[0] += own[k] * amplitude[k];
        sum[1] += own[next + k] * amplitude[k];
        sum[2] += own[2 * next + k] * amplitude[k];
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
        out[axis] = total(sum[axis]);
}

[[gnu::always_inline]] inline void expand_pair_body(const float* row, std::size_t stride,
                                                    std::size_t columns, const float* q,
                                                    const float* r, double* out,
                                                    double* other_out) {
    const std::size_t registers = columns / ModalBasis::kLanes;
    const std::size_t next = stride / ModalBasis::kLanes;
    const auto* const own = reinterpret_cast<const Lanes*>(row);
    const auto* const one = reinterpret_cast<const Lanes*>(q);
    const auto* const two = reinterpret_cast<const Lanes*>(r);
    Lanes sum[3] = {}, other[3] = {};
    for (std::size_t k = 0; k < registers; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sum[axis] += own[axis * next + k] * one[k];
            other[axis] += own[axis * next + k] * two[k];
        }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        out[axis] = total(sum[axis]);
        other_out[axis] = total(other[axis]);
    }
}

[[gnu::always_inline]] inline void project_body(const float* row, std::size_t stride,
                                                std::size_t columns, const double* f, double* q) {
    for (std::size_t k = 0; k < columns; ++k)
        q[k] += static_cast<double>(row[k]) * f[0] + static_cast<double>(row[stride + k]) * f[1] +
                static_cast<double>(row[2 * stride + k]) * f[2];
}

[[gnu::always_inline]] inline void project_scaled_body(const float* row, std::size_t stride,
                                                       std::size_t columns, const float* f,
                                                       const float* scale, float* q) {
    const std::size_t registers = columns / ModalBasis::kLanes;
    const std::size_t next = stride / ModalBasis::kLanes;
    const auto* const own = reinterpret_cast<const Lanes*>(row);
    const auto* const by = reinterpret_cast<const Lanes*>(scale);
    auto* const out = reinterpret_cast<Lanes*>(q);
    for (std::size_t k = 0; k < registers; ++k)
        out[k] += by[k] * (own[k] * f[0] + own[next + k] * f[1] + own[2 * next + k] * f[2]);
}

/// @param row  `count` nodes' rows.  @param f  three numbers each.
[[gnu::always_inline]] inline double square_body(const float* const* row, const float* f, int count,
                                                 std::size_t stride, std::size_t columns,
                                                 const float* scale) {
    const std::size_t registers = columns / ModalBasis::kLanes;
    const std::size_t next = stride / ModalBasis::kLanes;
    const auto* const by = reinterpret_cast<const Lanes*>(scale);
    Lanes sum = {};
    for (std::size_t k = 0; k < registers; ++k) {
        Lanes push = {};
        for (int i = 0; i < count; ++i) {
            const auto* const own = reinterpret_cast<const Lanes*>(row[i]);
            push +=
                own[k] * f[3 * i] + own[next + k] * f[3 * i + 1] + own[2 * next + k] * f[3 * i + 2];
        }
        sum += by[k] * push * push;
    }
    return total(sum);
}

[[gnu::always_inline]] inline void squares_body(const float* row, std::size_t stride,
                                                std::size_t columns, const float* scale,
                                                double* out) {
    const std::size_t registers = columns / ModalBasis::kLanes;
    const std::size_t next = stride / ModalBasis::kLanes;
    const auto* const own = reinterpret_cast<const Lanes*>(row);
    const auto* const by = reinterpret_cast<const Lanes*>(scale);
    Lanes sum[6] = {};
    for (std::size_t k = 0; k < registers; ++k) {
        const Lanes x = own[k], y = own[next + k], z = own[2 * next + k];
        const Lanes scaled_x = by[k] * x, scaled_y = by[k] * y;
        sum[0] += scaled_x * x;
        sum[1] += scaled_y * y;
        sum[2] += by[k] * z * z;
        sum[3] += scaled_x * y;
        sum[4] += scaled_x * z;
        sum[5] += scaled_y * z;
    }
    for (std::size_t i = 0; i < 6; ++i)
        out[i] = total(sum[i]);
}

[[gnu::always_inline]] inline void reaches_body(const float* row, std::size_t stride,
                                                std::size_t columns, const float* f, const float* q,
                                                const float* r, double* out) {
    const std::size_t registers = columns / ModalBasis::kLanes;
    const std::size_t next = stride / ModalBasis::kLanes;
    const auto* const own = reinterpret_cast<const Lanes*>(row);
    const auto* const one = reinterpret_cast<const Lanes*>(q);
    const auto* const two = reinterpret_cast<const Lanes*>(r);
    Lanes sum[2] = {};
    for (std::size_t k = 0; k < registers; ++k) {
        const Lanes along = own[k] * f[0] + own[next + k] * f[1] + own[2 * next + k] * f[2];
        const Lanes size = along < 0 ? -along : along;
        sum[0] += one[k] * size;
        sum[1] += two[k] * size;
    }
    out[0] = total(sum[0]);
    out[1] = total(sum[1]);
}

// The same arithmetic at either register width: equal bits.
#define ODE_SOFTBODY_BOTH(name, result, parameters, ...)                                           \
    result name##_narrow parameters { return name##_body(__VA_ARGS__); }                           \
    ODE_SOFTBODY_AVX2 result name##_wide parameters { return name##_body(__VA_ARGS__); }

ODE_SOFTBODY_BOTH(expand, void,
                  (const float* row, std::size_t stride, std::size_t columns, const float* q,
                   double* out),
                  row, stride, columns, q, out)
ODE_SOFTBODY_BOTH(expand_pair, void,
                  (const float* row, std::size_t stride, std::size_t columns, const float* q,
                   const float* r, double* out, double* other_out),
                  row, stride, columns, q, r, out, other_out)
ODE_SOFTBODY_BOTH(project, void,
                  (const float* row, std::size_t stride, std::size_t columns, const double* f,
                   double* q),
                  row, stride, columns, f, q)
ODE_SOFTBODY_BOTH(project_scaled, void,
                  (const float* row, std::size_t stride, std::size_t columns, const float* f,
                   const float* scale, float* q),
                  row, stride, columns, f, scale, q)
ODE_SOFTBODY_BOTH(square, double,
                  (const float* const* row, const float* f, int count, std::size_t stride,
                   std::size_t columns, const float* scale),
                  row, f, count, stride, columns, scale)
ODE_SOFTBODY_BOTH(squares, void,
                  (const float* row, std::size_t stride, std::size_t columns, const float* scale,
                   double* out),
                  row, stride, columns, scale, out)
ODE_SOFTBODY_BOTH(reaches, void,
                  (const float* row, std::size_t stride, std::size_t columns, const float* f,
                   const float* q, const float* r, double* out),
                  row, stride, columns, f, q, r, out)
#undef ODE_SOFTBODY_BOTH

} // namespace

void project(const ModalBasis& basis, std::size_t node, const Vec3& f,
             std::span<double> q) noexcept {
    project(basis.row(node, 0), basis.columns, f, q);
}

void project(const float* row, std::size_t stride, const Vec3& f, std::span<double> q) noexcept {
    (has_avx2() ? project_wide : project_narrow)(row, stride, q.size(), f.data(), q.data());
}

void project(const ModalBasis& basis, std::size_t node, const Vec3& f, std::span<const float> scale,
             std::span<float> q) noexcept {
    const Eigen::Vector3f single = f.cast<float>();
    (has_avx2() ? project_scaled_wide : project_scaled_narrow)(
        basis.row(node, 0), basis.columns, q.size(), single.data(), scale.data(), q.data());
}

double square(const ModalBasis& basis, const CarriedPoint& point, const Vec3& f,
              std::span<const float> scale) noexcept {
    const float* row[3];
    float part[9];
    int count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double w = point.weight[static_cast<int>(i)];
        if (w == 0)
            continue;
        row[count] = basis.row(static_cast<std::size_t>(point.node[i]), 0);
        Eigen::Map<Eigen::Vector3f>(part + 3 * count) = (w * f).cast<float>();
        ++count;
    }
    return (has_avx2() ? square_wide : square_narrow)(row, part, count, basis.columns, scale.size(),
                                                      scale.data());
}

std::array<double, 6> squares(const ModalBasis& basis, std::size_t node,
                              std::span<const float> scale) noexcept {
    std::array<double, 6> out;
    (has_avx2() ? squares_wide : squares_narrow)(basis.row(node, 0), basis.columns, scale.size(),
                                                 scale.data(), out.data());
    return out;
}

std::array<double, 2> reaches(const ModalBasis& basis, std::size_t node, const Vec3& f,
                              std::span<const float> q, std::span<const float> r) noexcept {
    const Eigen::Vector3f single = f.cast<float>();
    std::array<double, 2> out;
    (has_avx2() ? reaches_wide : reaches_narrow)(basis.row(node, 0), basis.columns, q.size(),
                                                 single.data(), q.data(), r.data(), out.data());
    return out;
}

Spread::Spread(const float* shape, std::size_t stride, std::span<const float> q) noexcept
    : shape_(shape), stride_(stride), q_(q.data()), columns_(q.size()),
      expand_(has_avx2() ? expand_wide : expand_narrow),
      expand_pair_(has_avx2() ? expand_pair_wide : expand_pair_narrow) {}

Spread::Spread(const ModalBasis& basis, std::span<const double> q,
               std::span<float> scratch) noexcept
    : Spread(basis, std::span<const float>(scratch.first(q.size()))) {
    std::transform(q.begin(), q.end(), scratch.begin(),
                   [](double x) { return static_cast<float>(x); });
}

} // namespace ode::soft
