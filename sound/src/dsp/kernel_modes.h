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
/// @param push  those that reach these columns.
template <int kGroups, bool kPushed>
inline void ring_groups(int columns, int samples, const float* step, int stride, float* q, float* v,
                        float* q_rows, float* v_rows, const RingPush* push, int pushes) {
    Floats a[kGroups], b[kGroups], c[kGroups], d[kGroups], x[kGroups], y[kGroups];
    for (int g = 0; g < kGroups; ++g) {
        a[g] = load_floats(step + g * kFloats);
        b[g] = load_floats(step + stride + g * kFloats);
        c[g] = load_floats(step + 2 * stride + g * kFloats);
        d[g] = load_floats(step + 3 * stride + g * kFloats);
        x[g] = load_floats(q + g * kFloats);
        y[g] = load_floats(v + g * kFloats);
    }
    for (int s = 0; s < samples; ++s) {
        for (int g = 0; g < kGroups; ++g) {
            const Floats next = x[g] + (a[g] * x[g] + b[g] * y[g]);
            y[g] = y[g] + (c[g] * x[g] + d[g] * y[g]);
            x[g] = next;
        }
        if constexpr (kPushed)
            for (int p = 0; p < pushes; ++p) {
                const RingPush& own = push[p];
                if (s < own.begin || s >= own.end)
                    continue;
                const float share = own.series[s];
                for (int g = 0; g < kGroups; ++g)
                    if (g * kFloats < own.columns) {
                        y[g] += share * load_floats(own.v + g * kFloats);
                        if (own.q)
                            x[g] += share * load_floats(own.q + g * kFloats);
                    }
            }
        for (int g = 0; g < kGroups; ++g) {
            store_floats(q_rows + s * columns + g * kFloats, x[g]);
            store_floats(v_rows + s * columns + g * kFloats, y[g]);
        }
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
    const auto next = [&](auto groups) {
        const auto run = [&](auto pushed, const RingPush* own, int count) {
            ring_groups<groups, pushed>(columns, samples, step + k, stride, q + k, v + k,
                                        q_rows + k, v_rows + k, own, count);
        };
        if constexpr (kPushed) {
            RingPush own[kMostPushes];
            int count = 0;
            for (int p = 0; p < pushes; ++p) {
                if (push[p].columns <= k)
                    continue;
                own[count] = push[p];
                own[count].columns -= k;
                own[count].v += k;
                if (own[count].q)
                    own[count].q += k;
                ++count;
            }
            run(std::true_type(), own, count);
        } else {
            run(std::false_type(), nullptr, 0);
        }
        k += groups * kFloats;
    };
    while (k + kMost * kFloats <= columns)
        next(std::integral_constant<int, kMost>());
    if constexpr (kMost > 2) {
        while (k + 3 * kFloats <= columns)
            next(std::integral_constant<int, 3>());
        while (k + 2 * kFloats <= columns)
            next(std::integral_constant<int, 2>());
    }
    while (k < columns)
        next(std::integral_constant<int, 1>());
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

template <int kBlock, int kHalf, int... kLane>
inline Floats halves(const Floats& x, const Floats& y, std::integer_sequence<int, kLane...>) {
    using Index [[gnu::vector_size(4 * kFloats)]] = std::int32_t;
    // Of each block of x, then of y, the first half or the second.
    return __builtin_shuffle(
        x, y,
        Index{(kLane / (kBlock / 2) * kBlock + kLane % (kBlock / 2) + kHalf * (kBlock / 2))...});
}

/// kFloats sums of all lanes at once, by halves and two at a time.
template <int kBlock>
inline Floats sums_of(const Floats* part) {
    if constexpr (kBlock == 1) {
        return *part;
    } else {
        constexpr auto kAll = std::make_integer_sequence<int, kFloats>();
        Floats next[kBlock / 2];
        for (int i = 0; i < kBlock / 2; ++i)
            next[i] = halves<kBlock, 0>(part[2 * i], part[2 * i + 1], kAll) +
                      halves<kBlock, 1>(part[2 * i], part[2 * i + 1], kAll);
        return sums_of<kBlock / 2>(next);
    }
}

template <int kSums>
inline void weigh_for(int columns, int samples, const float* const (*by)[2], const float* q_rows,
                      const float* v_rows, float* const* out) {
    int s = 0;
    const auto add = [&](int at, Floats* sum, int apart) {
        const float *q = q_rows + at * columns, *v = v_rows + at * columns;
        Floats own[kSums] = {};
        for (int k = 0; k < columns; k += kFloats) {
            const Floats x = load_floats(q + k), y = load_floats(v + k);
            for (int e = 0; e < kSums; ++e)
                own[e] += load_floats(by[e][0] + k) * x + load_floats(by[e][1] + k) * y;
        }
        for (int e = 0; e < kSums; ++e)
            sum[e * apart] = own[e];
    };
    for (; s + kFloats <= samples; s += kFloats) {
        Floats part[kSums * kFloats];
        for (int i = 0; i < kFloats; ++i)
            add(s + i, part + i, kFloats);
        for (int e = 0; e < kSums; ++e)
            store_floats(out[e] + s, sums_of<kFloats>(part + e * kFloats));
    }
    for (; s < samples; ++s) {
        Floats sum[kSums];
        add(s, sum, 1);
        for (int e = 0; e < kSums; ++e)
            out[e][s] = sum_of(sum[e]);
    }
}

void weigh(int columns, int samples, int sums, const float* const (*by)[2], const float* q_rows,
           const float* v_rows, float* const* out) {
    (sums == 4   ? weigh_for<4>
     : sums == 2 ? weigh_for<2>
                 : weigh_for<1>)(columns, samples, by, q_rows, v_rows, out);
}

} // namespace
} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE
