// Oscillators in rows: a part of kernel_bodies.h, which includes it once for each instruction set.

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {
namespace {

/// A register of floats.
constexpr int kFloats = 2 * kWide;
using Floats [[gnu::vector_size(4 * kFloats)]] = float;
using LooseFloats [[gnu::vector_size(4 * kFloats), gnu::aligned(4), gnu::may_alias]] = float;

inline Floats load_floats(const float* p) { return *reinterpret_cast<const LooseFloats*>(p); }
inline void store_floats(float* p, const Floats& v) { *reinterpret_cast<LooseFloats*>(p) = v; }

/// kGroups registers of oscillators at a time: each waits for itself, several fill the wait.
/// @param first  column of the rows and pushes that q and v begin with.
template <int kGroups, bool kPushed>
inline void ring_groups(int columns, int samples, const float* step, int stride, float* q, float* v,
                        float* q_rows, float* v_rows, const RingPush* push, int pushes, int first) {
    Floats a[kGroups], b[kGroups], c[kGroups], d[kGroups], x[kGroups], y[kGroups];
    for (int g = 0; g < kGroups; ++g) {
        a[g] = load_floats(step + g * kFloats);
        b[g] = load_floats(step + stride + g * kFloats);
        c[g] = load_floats(step + 2 * stride + g * kFloats);
        d[g] = load_floats(step + 3 * stride + g * kFloats);
        x[g] = load_floats(q + g * kFloats);
        y[g] = load_floats(v + g * kFloats);
    }
    for (int s = 0; s < samples; ++s)
        for (int g = 0; g < kGroups; ++g) {
            const Floats next = x[g] + (a[g] * x[g] + b[g] * y[g]);
            y[g] = y[g] + (c[g] * x[g] + d[g] * y[g]);
            x[g] = next;
            if constexpr (kPushed)
                for (int p = 0; p < pushes; ++p) {
                    const int at = first + g * kFloats;
                    const float share = push[p].series[s];
                    if (share == 0.0f || at >= push[p].columns)
                        continue;
                    y[g] += share * load_floats(push[p].v + at);
                    if (push[p].q)
                        x[g] += share * load_floats(push[p].q + at);
                }
            store_floats(q_rows + s * columns + g * kFloats, x[g]);
            store_floats(v_rows + s * columns + g * kFloats, y[g]);
        }
    for (int g = 0; g < kGroups; ++g) {
        store_floats(q + g * kFloats, x[g]);
        store_floats(v + g * kFloats, y[g]);
    }
}

template <bool kPushed>
inline void ring_all(int columns, int samples, const float* step, int stride, float* q, float* v,
                     float* q_rows, float* v_rows, const RingPush* push, int pushes) {
#if defined(__AVX512F__)
    constexpr int kMost = 4; // 24 of 32 registers
#else
    constexpr int kMost = 2; // 12 of 16
#endif
    int k = 0;
    for (; k + kMost * kFloats <= columns; k += kMost * kFloats)
        ring_groups<kMost, kPushed>(columns, samples, step + k, stride, q + k, v + k, q_rows + k,
                                    v_rows + k, push, pushes, k);
    if constexpr (kMost > 2) {
        for (; k + 3 * kFloats <= columns; k += 3 * kFloats)
            ring_groups<3, kPushed>(columns, samples, step + k, stride, q + k, v + k, q_rows + k,
                                    v_rows + k, push, pushes, k);
        for (; k + 2 * kFloats <= columns; k += 2 * kFloats)
            ring_groups<2, kPushed>(columns, samples, step + k, stride, q + k, v + k, q_rows + k,
                                    v_rows + k, push, pushes, k);
    }
    for (; k < columns; k += kFloats)
        ring_groups<1, kPushed>(columns, samples, step + k, stride, q + k, v + k, q_rows + k,
                                v_rows + k, push, pushes, k);
}

void ring(int columns, int samples, const float* step, int stride, float* q, float* v,
          float* q_rows, float* v_rows) {
    ring_all<false>(columns, samples, step, stride, q, v, q_rows, v_rows, nullptr, 0);
}

void ring_pushed(int columns, int samples, const float* step, int stride, float* q, float* v,
                 float* q_rows, float* v_rows, const RingPush* push, int pushes) {
    ring_all<true>(columns, samples, step, stride, q, v, q_rows, v_rows, push, pushes);
}

/// Sum of all lanes, by halves.
inline float sum_of(const Floats& v) {
    constexpr int kQuarter = 4;
    using Quad [[gnu::vector_size(16)]] = float;
    Quad sum{};
    for (int i = 0; i < kFloats / kQuarter; ++i) {
        Quad part;
        __builtin_memcpy(&part, reinterpret_cast<const char*>(&v) + 16 * i, sizeof part);
        sum += part;
    }
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

template <int kEars>
inline void weigh_for(int columns, int samples, const float* const (*by)[2], const float* q_rows,
                      const float* v_rows, float* const* out) {
    for (int s = 0; s < samples; ++s) {
        Floats even[kEars] = {}, odd[kEars] = {};
        const float *q = q_rows + s * columns, *v = v_rows + s * columns;
        for (int k = 0; k < columns; k += kFloats) {
            const Floats x = load_floats(q + k), y = load_floats(v + k);
            for (int e = 0; e < kEars; ++e) {
                even[e] += load_floats(by[e][0] + k) * x;
                odd[e] += load_floats(by[e][1] + k) * y;
            }
        }
        for (int e = 0; e < kEars; ++e)
            out[e][s] = sum_of(even[e] + odd[e]);
    }
}

void weigh(int columns, int samples, int ears, const float* const (*by)[2], const float* q_rows,
           const float* v_rows, float* const* out) {
    (ears == 2 ? weigh_for<2> : weigh_for<1>)(columns, samples, by, q_rows, v_rows, out);
}

} // namespace
} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE
