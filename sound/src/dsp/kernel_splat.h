// A surface's waves on their way to an ear: a part of kernel_bodies.h, which includes it once for
// each instruction set.

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {
namespace {

/// Waves of four nodes, as they arrive at an ear.
struct Arrivals {
    Ints whole;    ///< delay, rounded down [samples]
    Lane fraction; ///< the rest of it
    Lane value;
};

/// What all nodes have in common at one ear.
struct Aim {
    Lane centre;
    Lane mach;
    Lane rest;  ///< 1 - |mach|^2
    Lane scale; ///< 1 / rest
    Lane gain;
    Lane least;
    Lane most;
    Bits origin; ///< cell of a tap without delay
    Bits mask;
};

inline Aim aim(const SplatEar& ear) {
    const Lane mach = load(ear.mach);
    const double rest = 1.0 - (mach[0] * mach[0] + mach[1] * mach[1] + mach[2] * mach[2]);
    return {load(ear.position),  mach,
            fill(rest),          fill(1.0 / rest),
            fill(ear.gain),      fill(ear.min_delay),
            fill(ear.max_delay), fill_bits(ear.sample - kBefore),
            fill_bits(ear.mask)};
}

template <Facing kFacing>
inline Lane facing(const Lane& projection, const Lane& area, const Lane& distance) {
    const Lane zero{};
    // Area zero (a padding node, a vanished triangle): projection is zero too; avoid 0 / 0.
    const Lane cosine = projection / (area * distance + fill(1e-300));
    if constexpr (kFacing == Facing::kCosine) {
        return cosine > zero ? cosine : zero;
    } else {
        constexpr double kRamp = 0.05;
        const Lane one = fill(1.0);
        Lane seen = fill(0.5) + cosine * fill(0.5 / kRamp);
        seen = seen > zero ? seen : zero;
        return seen < one ? seen : one;
    }
}

template <Facing kFacing>
inline void arrive(const SplatSurface& surface, const Aim& ear, int i, Lane& soonest, Lane& latest,
                   Arrivals& out) {
    Lane offset[4];
    for (int k = 0; k < 4; ++k)
        offset[k] = ear.centre - load(surface.position + 4 * (i + k));
    const Lane square = sums(offset[0] * offset[0], offset[1] * offset[1], offset[2] * offset[2],
                             offset[3] * offset[3]) +
                        load(surface.softening + i);
    const Lane ahead = sums(offset[0] * ear.mach, offset[1] * ear.mach, offset[2] * ear.mach,
                            offset[3] * ear.mach);
    // Wave from x at time 0 meets an ear that starts at x + offset and moves with u = mach c:
    // |offset + u T| = c T. distance = c T.
    const Lane distance = (ahead + root(ahead * ahead + ear.rest * square)) * ear.scale;

    Lane value = ear.gain * load(surface.flow + i) / distance;
    if constexpr (kFacing == Facing::kLeaning) {
        Lane lean[4];
        for (int k = 0; k < 4; ++k)
            lean[k] = offset[k] * load(surface.lean + 4 * (i + k));
        const Lane per_distance = fill(1.0) / distance;
        value = ear.gain * per_distance *
                (load(surface.flow + i) + load(surface.lean_flow + i) * per_distance *
                                              sums(lean[0], lean[1], lean[2], lean[3]));
    } else if constexpr (kFacing != Facing::kAll) {
        Lane area[4];
        for (int k = 0; k < 4; ++k)
            area[k] = load(surface.area + 4 * (i + k));
        value *= facing<kFacing>(
            sums(area[0] * offset[0], area[1] * offset[1], area[2] * offset[2],
                 area[3] * offset[3]),
            root(sums(area[0] * area[0], area[1] * area[1], area[2] * area[2], area[3] * area[3])),
            distance);
    }

    // Comparisons with NaN are false: a body that has gone to pieces is silent, not contagious.
    constexpr double kSane = 1e20; // [m^2/s]
    const Lane delay = distance * fill(surface.samples_per_metre);
    const Bits sane =
        (delay >= ear.least) & (delay <= ear.most) & (value < fill(kSane)) & (value > fill(-kSane));
    const Lane when = sane ? delay : ear.least;
    value = sane ? value : Lane{};
    soonest = sane & (when < soonest) ? when : soonest;
    latest = sane & (when > latest) ? when : latest;

    out.whole = truncate(when);
    out.fraction = when - widen(out.whole);
    out.value = value;
}

/// One value into the ring of an ear.
inline void put(double* cell, const double* row, double at, double next) {
    for (int j = 0; j < kTaps; j += kWide)
        store_wide(cell + j, load_wide(cell + j) + (fill_wide(at) * load_wide(row + j) +
                                                    fill_wide(next) * load_wide(row + kTaps + j)));
}

/// Four of them, each by itself.
inline void put(const Arrivals& a, const Aim& aim, const double* table, double* const* ring) {
    const Lane place = a.fraction * fill(kPhases);
    const Ints phase = truncate(place);
    const Lane next = (place - widen(phase)) * a.value;
    const Lane at = a.value - next;
    const Bits cell = (aim.origin + __builtin_convertvector(a.whole, Bits)) & aim.mask;
    const Bits row = __builtin_convertvector(phase, Bits) * kTaps;
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k)
        put(ring[k % SplatEar::kCopies] + cell[k], table + row[k], at[k], next[k]);
}

constexpr int kMoments = 8;
constexpr int kChunk = 512; ///< nodes at a time
constexpr int kSpan = 192;  ///< cells that their arrivals may be apart
/// Nodes a cell, from which on sums cost less than nodes by themselves.
constexpr int kSumsPay = 2;

/// Bit `kBit` of a moment's number, for the moments kFirst on: one or p.
template <int kBit, int kFirst, int... kLane>
inline Wide choose(const Wide& p, std::integer_sequence<int, kLane...>) {
    using Mask [[gnu::vector_size(8 * kWide)]] = std::int64_t;
    return Mask{(((kFirst + kLane) >> kBit) & 1 ? -1 : 0)...} ? p : fill_wide(1.0);
}

/// value times 1, p, p^2 ... p^7, added.
template <int kFirst = 0>
inline void add_moments(double* to, const Wide& value, const Wide& p, const Wide& p2,
                        const Wide& p4) {
    constexpr auto kLanes = std::make_integer_sequence<int, kWide>();
    Wide power = value * choose<0, kFirst>(p, kLanes);
    power *= choose<1, kFirst>(p2, kLanes);
    power *= choose<2, kFirst>(p4, kLanes);
    store_wide(to + kFirst, load_wide(to + kFirst) + power);
    if constexpr (kFirst + kWide < kMoments)
        add_moments<kFirst + kWide>(to, value, p, p2, p4);
}

/// Waves of up to kChunk nodes at one ear.
struct Chunk {
    Arrivals arrival[kChunk / 4];
    int groups = 0;       ///< of four
    Lane soonest, latest; ///< whole delays of those that are heard
};

/// What arrives within the same sample is summed before it is spread: a tap is a polynomial in the
/// fraction of the delay, so that eight sums of value x fraction^m stand for all of them.
inline void sum_and_put(const Chunk& chunk, int first, int span, const Aim& aim,
                        const double* moment, double* const* ring) {
    constexpr int kCopies = SplatEar::kCopies;
    alignas(64) double window[kCopies][kSpan * kMoments];
    for (int c = 0; c < kCopies; ++c)
        for (int k = 0; k < span * kMoments; k += kWide)
            store_wide(window[c] + k, Wide{});
    for (int g = 0; g < chunk.groups; ++g) {
        const Arrivals& a = chunk.arrival[g];
        const Lane p = a.fraction - fill(0.5), p2 = p * p, p4 = p2 * p2;
#pragma GCC unroll 4
        for (int k = 0; k < 4; ++k) {
            // One that is not heard has no value; its delay may be anything.
            const int cell = a.whole[k] - first;
            double* const to =
                window[k % kCopies] + kMoments * (cell < 0 || cell >= span ? 0 : cell);
            add_moments(to, fill_wide(a.value[k]), fill_wide(p[k]), fill_wide(p2[k]),
                        fill_wide(p4[k]));
        }
    }
    for (int c = 0; c < span; ++c) {
        double all[kMoments];
        for (int m = 0; m < kMoments; m += kWide) {
            Wide sum = load_wide(window[0] + kMoments * c + m);
            for (int copy = 1; copy < kCopies; ++copy)
                sum += load_wide(window[copy] + kMoments * c + m);
            store_wide(all + m, sum);
        }
        double* const cell = ring[c % kCopies] + ((aim.origin[0] + first + c) & aim.mask[0]);
        for (int j = 0; j < kTaps; j += kWide) {
            Wide tap = load_wide(cell + j);
            for (int m = 0; m < kMoments; ++m)
                tap += fill_wide(all[m]) * load_wide(moment + m * kTaps + j);
            store_wide(cell + j, tap);
        }
    }
}

/// The number of ears is known here, so that everything stays in registers that can.
template <Facing kFacing, int kEars>
double splat_to(const SplatSurface& surface, const SplatEar* ear) {
    Lane last{};
    Aim aims[kEars];
    for (int e = 0; e < kEars; ++e)
        aims[e] = aim(ear[e]);
    for (int begin = 0; begin < surface.nodes; begin += kChunk) {
        const int end = surface.nodes - begin < kChunk ? surface.nodes : begin + kChunk;
        Chunk chunk[kEars];
        for (int e = 0; e < kEars; ++e) {
            chunk[e].soonest = fill(1e9);
            chunk[e].latest = Lane{};
        }
        for (int i = begin; i < end; i += 4)
            for (int e = 0; e < kEars; ++e)
                arrive<kFacing>(surface, aims[e], i, chunk[e].soonest, chunk[e].latest,
                                chunk[e].arrival[chunk[e].groups++]);
        for (int e = 0; e < kEars; ++e) {
            double soonest = chunk[e].soonest[0], latest = chunk[e].latest[0];
            for (int k = 1; k < 4; ++k) {
                soonest = chunk[e].soonest[k] < soonest ? chunk[e].soonest[k] : soonest;
                latest = chunk[e].latest[k] > latest ? chunk[e].latest[k] : latest;
            }
            last = chunk[e].latest > last ? chunk[e].latest : last;
            const int first = static_cast<int>(soonest);
            const int span = soonest <= latest ? static_cast<int>(latest) - first + 1 : 0;
            if (span <= kSpan && kSumsPay * span <= end - begin)
                sum_and_put(chunk[e], first, span, aims[e], surface.moment, ear[e].ring);
            else
                for (int g = 0; g < chunk[e].groups; ++g)
                    put(chunk[e].arrival[g], aims[e], surface.table, ear[e].ring);
        }
    }
    double all = 0.0;
    for (int k = 0; k < 4; ++k)
        all = last[k] > all ? last[k] : all;
    return all;
}

template <Facing kFacing>
double splat(const SplatSurface& surface, const SplatEar* ear, int ears) {
    return ears == 2 ? splat_to<kFacing, 2>(surface, ear) : splat_to<kFacing, 1>(surface, ear);
}

} // namespace
} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE
