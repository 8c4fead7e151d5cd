#include "fma_peak.h"

#include <immintrin.h>

#include <algorithm>

namespace ode::soft {
namespace {

constexpr int kChains = 12; // independent sums: latency 4, two units, some slack
constexpr int kRounds = 400000;

/// Without a fused multiply-add: as many products as sums, each in chains of its own.
double baseline_loop() {
    __m128d sum[kChains / 2]{}, product[kChains / 2]{};
    const __m128d a = _mm_set1_pd(0.999999), b = _mm_set1_pd(1e-9);
    for (int r = 0; r < 2 * kRounds; ++r) {
#pragma GCC unroll 6
        for (int i = 0; i < kChains / 2; ++i) {
            __m128d s = _mm_add_pd(sum[i], b), p = _mm_mul_pd(product[i], a);
            asm("" : "+x"(s), "+x"(p));
            sum[i] = s;
            product[i] = p;
        }
    }
    double out = 0;
#pragma GCC unroll 6
    for (int i = 0; i < kChains / 2; ++i)
        out += sum[i][0] + product[i][0];
    return out;
}

[[gnu::target("avx2,fma")]] double avx2_loop() {
    __m256d sum[kChains]{};
    const __m256d a = _mm256_set1_pd(0.999999), b = _mm256_set1_pd(1e-9);
    for (int r = 0; r < kRounds; ++r) {
#pragma GCC unroll 12
        for (int i = 0; i < kChains; ++i) {
            __m256d& s = sum[i];
            s = _mm256_fmadd_pd(s, a, b);
            asm("" : "+x"(s));
        }
    }
    double out = 0;
#pragma GCC unroll 12
    for (int i = 0; i < kChains; ++i)
        out += sum[i][0];
    return out;
}

[[gnu::target("avx512f")]] double avx512_loop() {
    __m512d sum[kChains]{};
    const __m512d a = _mm512_set1_pd(0.999999), b = _mm512_set1_pd(1e-9);
    for (int r = 0; r < kRounds; ++r) {
#pragma GCC unroll 12
        for (int i = 0; i < kChains; ++i) {
            __m512d& s = sum[i];
            s = _mm512_fmadd_pd(s, a, b);
            asm("" : "+v"(s));
        }
    }
    double out = 0;
#pragma GCC unroll 12
    for (int i = 0; i < kChains; ++i)
        out += sum[i][0];
    return out;
}

volatile double sink;

double measure(double (*loop)(), int width) {
    double best = 1e300;
    for (int i = 0; i < 20; ++i) {
        const double start = thread_seconds();
        sink = loop();
        best = std::min(best, thread_seconds() - start);
    }
    return 2.0 * width * kChains * kRounds / best;
}

} // namespace

double fma_peak(Isa isa) {
    switch (isa) {
    case Isa::avx512:
        return measure(avx512_loop, 8);
    case Isa::avx2:
        return measure(avx2_loop, 4);
    default:
        return measure(baseline_loop, 2);
    }
}

} // namespace ode::soft
