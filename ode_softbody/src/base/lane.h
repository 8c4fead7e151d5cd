#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

// Several elements side by side, for the force kernels. A kernel is a template over Lane<W> and is
// compiled once for every instruction set, in a translation unit with that set's flags. Everything
// such a unit instantiates lives in a namespace named after the set (ODE_SOFT_ISA, defined by the
// build), so that the linker can never hand AVX code to a machine without it. For the same reason
// the unit includes no Eigen and no standard container.
#ifndef ODE_SOFT_ISA
#define ODE_SOFT_ISA scalar
#endif
#define ODE_SOFT_LANE [[gnu::always_inline]] static inline

namespace ode::soft::ODE_SOFT_ISA {

/// W doubles, one an element. Value has + - * / between lanes and with a double; fma(a, b, c) is
/// a*b + c, rounded once where the hardware can (and in the scalar oracle), so that one element,
/// four and eight give the same bits.
///
/// Points are W nodes as they lie in memory (x y z 0, see NodeArray): gathered by whole-register
/// loads, transposed in registers to one Value per coordinate, and back. Transposing costs 7 or 8
/// shuffles, so kernels take differences of Points before they transpose.
template <int kLanes>
struct Lane;

/// The oracle of the wide lanes.
template <>
struct Lane<1> {
    static constexpr int kWidth = 1;
    using Value = double;
    struct Points {
        double at[3];
    };

    ODE_SOFT_LANE Value load(const double* p) { return *p; }
    ODE_SOFT_LANE Value fma(Value a, Value b, Value c) { return __builtin_fma(a, b, c); }
    ODE_SOFT_LANE Value sqrt(Value a) { return __builtin_sqrt(a); }
    ODE_SOFT_LANE Value min(Value a, Value b) { return a < b ? a : b; }
    ODE_SOFT_LANE Value max(Value a, Value b) { return a > b ? a : b; }

    ODE_SOFT_LANE Points gather(const double* base, const unsigned* at) {
        const double* p = base + *at;
        return {{p[0], p[1], p[2]}};
    }
    ODE_SOFT_LANE Points sum(const Points& a, const Points& b) {
        return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]}};
    }
    ODE_SOFT_LANE Points difference(const Points& a, const Points& b) {
        return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
    }
    ODE_SOFT_LANE void to_lanes(const Points& p, Value out[3]) {
        for (int i = 0; i < 3; ++i)
            out[i] = p.at[i];
    }
    ODE_SOFT_LANE Points to_points(const Value in[3]) { return {{in[0], in[1], in[2]}}; }
    template <int kWhich>
    ODE_SOFT_LANE void add(double* node, const Points& p) {
        for (int i = 0; i < 3; ++i)
            node[i] += p.at[i];
    }
    template <int kWhich>
    ODE_SOFT_LANE void subtract(double* node, const Points& p) {
        for (int i = 0; i < 3; ++i)
            node[i] -= p.at[i];
    }
};

/// Arithmetic shared by the wide lanes.
template <int kLanes>
struct VectorLane {
    static constexpr int kWidth = kLanes;
    using Value [[gnu::vector_size(8 * kLanes)]] = double;
    using Loose [[gnu::vector_size(8 * kLanes), gnu::aligned(8), gnu::may_alias]] = double;

    ODE_SOFT_LANE Value load(const double* p) { return *reinterpret_cast<const Loose*>(p); }
    ODE_SOFT_LANE void store(double* p, Value v) { *reinterpret_cast<Loose*>(p) = v; }
    ODE_SOFT_LANE Value min(Value a, Value b) { return a < b ? a : b; }
    ODE_SOFT_LANE Value max(Value a, Value b) { return a > b ? a : b; }
};

/// What every 64-bit target has: SSE2, NEON. No fused multiply-add.
template <>
struct Lane<2> : VectorLane<2> {
    struct Points {
        Value at[2][2]; ///< point, (x y) or (z 0)
    };

    ODE_SOFT_LANE Value fma(Value a, Value b, Value c) { return a * b + c; }
    ODE_SOFT_LANE Value sqrt(Value a) {
#if defined(__SSE2__)
        return _mm_sqrt_pd(a);
#else
        return Value{__builtin_sqrt(a[0]), __builtin_sqrt(a[1])};
#endif
    }

    ODE_SOFT_LANE Points gather(const double* base, const unsigned* at) {
        const double* p = base + at[0];
        const double* q = base + at[1];
        return {{{load(p), load(p + 2)}, {load(q), load(q + 2)}}};
    }
    ODE_SOFT_LANE Points sum(const Points& a, const Points& b) {
        return {{{a.at[0][0] + b.at[0][0], a.at[0][1] + b.at[0][1]},
                 {a.at[1][0] + b.at[1][0], a.at[1][1] + b.at[1][1]}}};
    }
    ODE_SOFT_LANE Points difference(const Points& a, const Points& b) {
        return {{{a.at[0][0] - b.at[0][0], a.at[0][1] - b.at[0][1]},
                 {a.at[1][0] - b.at[1][0], a.at[1][1] - b.at[1][1]}}};
    }
    ODE_SOFT_LANE void to_lanes(const Points& p, Value out[3]) {
        out[0] = __builtin_shufflevector(p.at[0][0], p.at[1][0], 0, 2);
        out[1] = __builtin_shufflevector(p.at[0][0], p.at[1][0], 1, 3);
        out[2] = __builtin_shufflevector(p.at[0][1], p.at[1][1], 0, 2);
    }
    ODE_SOFT_LANE Points to_points(const Value in[3]) {
        const Value zero{};
        return {{{__builtin_shufflevector(in[0], in[1], 0, 2),
                  __builtin_shufflevector(in[2], zero, 0, 2)},
                 {__builtin_shufflevector(in[0], in[1], 1, 3),
                  __builtin_shufflevector(in[2], zero, 1, 2)}}};
    }
    template <int kWhich>
    ODE_SOFT_LANE void add(double* node, const Points& p) {
        store(node, load(node) + p.at[kWhich][0]);
        store(node + 2, load(node + 2) + p.at[kWhich][1]);
    }
    template <int kWhich>
    ODE_SOFT_LANE void subtract(double* node, const Points& p) {
        store(node, load(node) - p.at[kWhich][0]);
        store(node + 2, load(node + 2) - p.at[kWhich][1]);
    }
};

#if defined(__AVX2__) && defined(__FMA__)
template <>
struct Lane<4> : VectorLane<4> {
    struct Points {
        Value at[4]; ///< x y z 0
    };

    ODE_SOFT_LANE Value fma(Value a, Value b, Value c) { return _mm256_fmadd_pd(a, b, c); }
    ODE_SOFT_LANE Value sqrt(Value a) { return _mm256_sqrt_pd(a); }

    ODE_SOFT_LANE Points gather(const double* base, const unsigned* at) {
        return {{load(base + at[0]), load(base + at[1]), load(base + at[2]), load(base + at[3])}};
    }
    ODE_SOFT_LANE Points sum(const Points& a, const Points& b) {
        return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2], a.at[3] + b.at[3]}};
    }
    ODE_SOFT_LANE Points difference(const Points& a, const Points& b) {
        return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2], a.at[3] - b.at[3]}};
    }
    ODE_SOFT_LANE void to_lanes(const Points& p, Value out[3]) {
        const Value xz01 = __builtin_shufflevector(p.at[0], p.at[1], 0, 4, 2, 6);
        const Value xz23 = __builtin_shufflevector(p.at[2], p.at[3], 0, 4, 2, 6);
        const Value y01 = __builtin_shufflevector(p.at[0], p.at[1], 1, 5, 3, 7);
        const Value y23 = __builtin_shufflevector(p.at[2], p.at[3], 1, 5, 3, 7);
        out[0] = __builtin_shufflevector(xz01, xz23, 0, 1, 4, 5);
        out[1] = __builtin_shufflevector(y01, y23, 0, 1, 4, 5);
        out[2] = __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7);
    }
    ODE_SOFT_LANE Points to_points(const Value in[3]) {
        const Value zero{};
        const Value xz01 = __builtin_shufflevector(in[0], in[2], 0, 1, 4, 5);
        const Value xz23 = __builtin_shufflevector(in[0], in[2], 2, 3, 6, 7);
        const Value y01 = __builtin_shufflevector(in[1], zero, 0, 1, 4, 5);
        const Value y23 = __builtin_shufflevector(in[1], zero, 2, 3, 6, 7);
        return {{__builtin_shufflevector(xz01, y01, 0, 4, 2, 6),
                 __builtin_shufflevector(xz01, y01, 1, 5, 3, 7),
                 __builtin_shufflevector(xz23, y23, 0, 4, 2, 6),
                 __builtin_shufflevector(xz23, y23, 1, 5, 3, 7)}};
    }
    template <int kWhich>
    ODE_SOFT_LANE void add(double* node, const Points& p) {
        store(node, load(node) + p.at[kWhich]);
    }
    template <int kWhich>
    ODE_SOFT_LANE void subtract(double* node, const Points& p) {
        store(node, load(node) - p.at[kWhich]);
    }
};
#endif

#if defined(__AVX512F__)
template <>
struct Lane<8> : VectorLane<8> {
    /// Register r holds points first(r) and first(r) + 2: with that pairing the transposes are
    /// single in-lane unpacks and 128-bit shuffles.
    struct Points {
        Value at[4];
    };

    ODE_SOFT_LANE Value fma(Value a, Value b, Value c) { return _mm512_fmadd_pd(a, b, c); }
    // With all lanes: GCC 12 takes the plain form's undefined operand for a mistake of ours.
    ODE_SOFT_LANE Value sqrt(Value a) { return _mm512_maskz_sqrt_pd(0xff, a); }

    ODE_SOFT_LANE Value pair(const double* p, const double* q) {
        return __builtin_shufflevector(_mm256_loadu_pd(p), _mm256_loadu_pd(q), 0, 1, 2, 3, 4, 5, 6,
                                       7);
    }
    ODE_SOFT_LANE Points gather(const double* base, const unsigned* at) {
        return {{pair(base + at[0], base + at[2]), pair(base + at[1], base + at[3]),
                 pair(base + at[4], base + at[6]), pair(base + at[5], base + at[7])}};
    }
    ODE_SOFT_LANE Points sum(const Points& a, const Points& b) {
        return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2], a.at[3] + b.at[3]}};
    }
    ODE_SOFT_LANE Points difference(const Points& a, const Points& b) {
        return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2], a.at[3] - b.at[3]}};
    }
    ODE_SOFT_LANE Value low(Value a, Value b) {
        return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    }
    ODE_SOFT_LANE Value high(Value a, Value b) {
        return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    }
    ODE_SOFT_LANE void to_lanes(const Points& p, Value out[3]) {
        const Value xz0 = low(p.at[0], p.at[1]), xz4 = low(p.at[2], p.at[3]);
        const Value y0 = high(p.at[0], p.at[1]), y4 = high(p.at[2], p.at[3]);
        out[0] = __builtin_shufflevector(xz0, xz4, 0, 1, 4, 5, 8, 9, 12, 13);
        out[1] = __builtin_shufflevector(y0, y4, 0, 1, 4, 5, 8, 9, 12, 13);
        out[2] = __builtin_shufflevector(xz0, xz4, 2, 3, 6, 7, 10, 11, 14, 15);
    }
    ODE_SOFT_LANE Points to_points(const Value in[3]) {
        const Value zero{};
        const Value xz0 = __builtin_shufflevector(in[0], in[2], 0, 1, 8, 9, 2, 3, 10, 11);
        const Value xz4 = __builtin_shufflevector(in[0], in[2], 4, 5, 12, 13, 6, 7, 14, 15);
        const Value y0 = __builtin_shufflevector(in[1], zero, 0, 1, 8, 9, 2, 3, 10, 11);
        const Value y4 = __builtin_shufflevector(in[1], zero, 4, 5, 12, 13, 6, 7, 14, 15);
        return {{low(xz0, y0), high(xz0, y0), low(xz4, y4), high(xz4, y4)}};
    }
    template <int kWhich>
    ODE_SOFT_LANE __m256d one(const Points& p) {
        const Value pair = p.at[(kWhich & 1) + (kWhich & 4) / 2];
        if constexpr ((kWhich & 2) == 0)
            return __builtin_shufflevector(pair, pair, 0, 1, 2, 3);
        else
            return __builtin_shufflevector(pair, pair, 4, 5, 6, 7);
    }
    template <int kWhich>
    ODE_SOFT_LANE void add(double* node, const Points& p) {
        _mm256_storeu_pd(node, _mm256_loadu_pd(node) + one<kWhich>(p));
    }
    template <int kWhich>
    ODE_SOFT_LANE void subtract(double* node, const Points& p) {
        _mm256_storeu_pd(node, _mm256_loadu_pd(node) - one<kWhich>(p));
    }
};
using WideLane = Lane<8>;
#elif defined(__AVX2__) && defined(__FMA__)
using WideLane = Lane<4>;
#else
using WideLane = Lane<2>;
#endif

/// Calls action.template operator()<i>() for i = 0 .. kCount-1, unrolled.
template <int kCount, int kFirst = 0, class Action>
[[gnu::always_inline]] inline void unroll(const Action& action) {
    if constexpr (kFirst < kCount) {
        action.template operator()<kFirst>();
        unroll<kCount, kFirst + 1>(action);
    }
}

} // namespace ode::soft::ODE_SOFT_ISA
