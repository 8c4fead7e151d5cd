// Included by kernel_bodies.h, once for each instruction set, in its namespace: the vectors that
// kernels reckon in.
#pragma once

#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {
namespace {

using Lane [[gnu::vector_size(32)]] = double;
using Loose [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;
using Bits [[gnu::vector_size(32)]] = std::int64_t;
using LooseBits [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = std::int64_t;
using Ints [[gnu::vector_size(16)]] = std::int32_t;

inline Lane load(const double* p) { return *reinterpret_cast<const Loose*>(p); }
inline void store(double* p, const Lane& v) { *reinterpret_cast<Loose*>(p) = v; }
inline void store_bits(std::int64_t* p, const Bits& v) { *reinterpret_cast<LooseBits*>(p) = v; }
inline Lane fill(double v) { return Lane{v, v, v, v}; }
inline Bits fill_bits(std::int64_t v) { return Bits{v, v, v, v}; }

/// As wide as the machine is, for loops over contiguous numbers.
#if defined(__AVX512F__)
constexpr int kWide = 8;
#elif defined(__AVX2__)
constexpr int kWide = 4;
#else
constexpr int kWide = 2;
#endif
using Wide [[gnu::vector_size(8 * kWide)]] = double;
using LooseWide [[gnu::vector_size(8 * kWide), gnu::aligned(8), gnu::may_alias]] = double;

inline Wide load_wide(const double* p) { return *reinterpret_cast<const LooseWide*>(p); }
inline void store_wide(double* p, const Wide& v) { *reinterpret_cast<LooseWide*>(p) = v; }
inline Wide fill_wide(double v) { return v - Wide{}; }

inline Lane root(const Lane& v) {
#if defined(__AVX2__)
    return _mm256_sqrt_pd(v);
#else
    return Lane{__builtin_sqrt(v[0]), __builtin_sqrt(v[1]), __builtin_sqrt(v[2]),
                __builtin_sqrt(v[3])};
#endif
}

/// GCC 12 makes two halves of the conversions and puts them together again.
inline Ints truncate(const Lane& v) {
#if defined(__AVX2__)
    return reinterpret_cast<Ints>(_mm256_cvttpd_epi32(v));
#else
    return __builtin_convertvector(v, Ints);
#endif
}

inline Lane widen(const Ints& v) {
#if defined(__AVX2__)
    return _mm256_cvtepi32_pd(reinterpret_cast<__m128i>(v));
#else
    return __builtin_convertvector(v, Lane);
#endif
}

/// x + y + z of four points, one a lane; w does not count, whatever it holds.
inline Lane sums(const Lane& a, const Lane& b, const Lane& c, const Lane& d) {
    const Lane ab_x = __builtin_shuffle(a, b, Bits{0, 4, 2, 6}); // ax bx az bz
    const Lane ab_y = __builtin_shuffle(a, b, Bits{1, 5, 3, 7}); // ay by aw bw
    const Lane cd_x = __builtin_shuffle(c, d, Bits{0, 4, 2, 6});
    const Lane cd_y = __builtin_shuffle(c, d, Bits{1, 5, 3, 7});
    const Lane x = __builtin_shuffle(ab_x, cd_x, Bits{0, 1, 4, 5});
    const Lane z = __builtin_shuffle(ab_x, cd_x, Bits{2, 3, 6, 7});
    const Lane y = __builtin_shuffle(ab_y, cd_y, Bits{0, 1, 4, 5});
    return x + y + z;
}

inline Lane without_w(const Lane& v) {
    return reinterpret_cast<Lane>(reinterpret_cast<Bits>(v) & Bits{-1, -1, -1, 0});
}

inline Lane cross(const Lane& a, const Lane& b) {
    constexpr Bits kYzx{1, 2, 0, 3};
    return __builtin_shuffle(a * __builtin_shuffle(b, kYzx) - __builtin_shuffle(a, kYzx) * b, kYzx);
}

} // namespace
} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE
