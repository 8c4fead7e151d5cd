// Compiled once for every instruction set.
#include "reduced/cubic_rows.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include <cstring>

namespace ode::soft::ODE_SOFT_ISA {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t kWidth = 16;
#elif defined(__AVX2__)
constexpr std::size_t kWidth = 8;
#else
constexpr std::size_t kWidth = 4;
#endif
constexpr std::size_t kParts = kRowLanes / kWidth;
typedef float Part __attribute__((vector_size(4 * kWidth)));
typedef float Quad __attribute__((vector_size(16)));

[[gnu::always_inline]] inline Part fused(Part a, Part b, Part c) {
#if defined(__AVX512F__)
    return _mm512_fmadd_ps(a, b, c);
#elif defined(__AVX2__)
    return _mm256_fmadd_ps(a, b, c);
#else
    return a * b + c;
#endif
}

/// Lanes 0 4 8 12, 1 5 9 13, and so on.
[[gnu::always_inline]] inline Quad folded(const Part (&lanes)[kParts]) {
    Quad quad[kRowLanes / 4];
    std::memcpy(quad, lanes, sizeof quad);
    return (quad[0] + quad[1]) + (quad[2] + quad[3]);
}

template <std::size_t kRows>
[[gnu::always_inline]] inline void add_some(const float* coefficient, const RowBlock& block,
                                            const float* by, const float* product, float* answer,
                                            float* sum) {
    const auto* const p = reinterpret_cast<const Part*>(product);
    auto* const s = reinterpret_cast<Part*>(sum);
    const auto* const c = reinterpret_cast<const Part*>(coefficient + block.offset);
    Part dot[kRowsAtOnce][kParts] = {};
    for (std::size_t v = 0; v < block.registers; ++v)
        for (std::size_t part = 0; part < kParts; ++part) {
            const std::size_t i = v * kParts + part;
            const Part here = p[i];
            Part added = s[i];
            for (std::size_t r = 0; r < kRows; ++r) {
                const Part own = c[r * block.stride * kParts + i];
                dot[r][part] = fused(own, here, dot[r][part]);
                added = fused(own, Part{} + by[r], added);
            }
            s[i] = added;
        }
    // Four sums at once: rows across, added up down the columns.
    const Quad row[] = {folded(dot[0]), folded(dot[1]), folded(dot[2]), folded(dot[3])};
    const auto halves = [](const Quad& one, const Quad& two) {
        return __builtin_shufflevector(one, two, 0, 4, 1, 5) +
               __builtin_shufflevector(one, two, 2, 6, 3, 7);
    };
    const Quad first = halves(row[0], row[1]), second = halves(row[2], row[3]);
    const Quad all = __builtin_shufflevector(first, second, 0, 1, 4, 5) +
                     __builtin_shufflevector(first, second, 2, 3, 6, 7);
    std::memcpy(answer, &all, sizeof all);
}

void run(const float* coefficient, std::span<const RowBlock> blocks, const float* by,
         const float* product, float* answer, float* sum) {
    for (const RowBlock& block : blocks) {
        switch (block.rows) {
        case 1:
            add_some<1>(coefficient, block, by, product, answer, sum);
            break;
        case 2:
            add_some<2>(coefficient, block, by, product, answer, sum);
            break;
        case 3:
            add_some<3>(coefficient, block, by, product, answer, sum);
            break;
        default:
            add_some<kRowsAtOnce>(coefficient, block, by, product, answer, sum);
        }
        by += block.rows;
        answer += block.rows;
    }
}

} // namespace

AddRows add_rows();

AddRows add_rows() { return run; }

} // namespace ode::soft::ODE_SOFT_ISA
