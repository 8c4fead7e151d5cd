// Included by one translation unit for each instruction set, with ODE_SOUND_ISA_NAMESPACE naming
// it, so that the linker never hands AVX code to a machine without it. No standard container here.
#include "dsp/kernel_lanes.h"
#include "dsp/kernels.h"

#include <utility>

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {
namespace {

constexpr int kTaps = 16;
constexpr int kBefore = 7;
constexpr int kPhases = 512;

double dot(const double* a, const double* b, int n) {
    Lane even{};
    Lane odd{};
    int i = 0;
    for (; i + 8 <= n; i += 8) {
        even += load(a + i) * load(b + i);
        odd += load(a + i + 4) * load(b + i + 4);
    }
    if (i < n)
        even += load(a + i) * load(b + i);
    const Lane sum = even + odd;
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

void differences(int nodes, const double* const row[8], double own[4], double next[4]) {
    Lane square[4] = {}, product[4] = {};
    for (int i = 0; i < nodes; i += 4) {
        Lane first[7], third[5];
        for (int k = 0; k < 7; ++k)
            first[k] = load(row[k] + i) - load(row[k + 1] + i);
        for (int k = 0; k < 5; ++k)
            third[k] = (first[k] - first[k + 1]) - (first[k + 1] - first[k + 2]);
        for (int k = 0; k < 4; ++k) {
            square[k] += third[k] * third[k];
            product[k] += third[k] * third[k + 1];
        }
    }
    for (int k = 0; k < 4; ++k) {
        own[k] = (square[k][0] + square[k][1]) + (square[k][2] + square[k][3]);
        next[k] = (product[k][0] + product[k][1]) + (product[k][2] + product[k][3]);
    }
}

void gather(int nodes, const int* node, const double* position, int stride, const double* area,
            double* last, double* volume) {
    for (int i = 0; i < nodes; i += 4) {
        Lane swept[4];
        for (int k = 0; k < 4; ++k) {
            const Lane now = load(position + static_cast<std::int64_t>(node[i + k]) * stride);
            swept[k] = (now - load(last + 4 * (i + k))) * load(area + 4 * (i + k));
            store(last + 4 * (i + k), without_w(now));
        }
        store(volume + i, sums(swept[0], swept[1], swept[2], swept[3]));
    }
}

void between(int nodes, const int* node, const double* position, int stride, const double* last,
             double fraction, double* place) {
    const Lane f = fill(fraction);
    for (int i = 0; i < nodes; ++i) {
        const Lane from = load(last + 4 * i);
        const Lane now = load(position + static_cast<std::int64_t>(node[i]) * stride);
        store(place + 4 * i, without_w(from + f * (now - from)));
    }
}

void areas(int triangles, const int* triangle, const double* point, double* area) {
    const Lane sixth = fill(1.0 / 6.0);
    for (int t = 0; t < triangles; ++t) {
        const std::int64_t i = 4 * static_cast<std::int64_t>(triangle[3 * t]);
        const std::int64_t j = 4 * static_cast<std::int64_t>(triangle[3 * t + 1]);
        const std::int64_t k = 4 * static_cast<std::int64_t>(triangle[3 * t + 2]);
        const Lane origin = load(point + i);
        const Lane third =
            without_w(sixth * cross(load(point + j) - origin, load(point + k) - origin));
        store(area + i, load(area + i) + third);
        store(area + j, load(area + j) + third);
        store(area + k, load(area + k) + third);
    }
}

void mix(int nodes, int rows, const double* const* row, const double* weight, double* const* flow) {
    int i = 0;
    for (; i + 2 * kWide <= nodes; i += 2 * kWide) {
        Wide a[4] = {};
        Wide b[4] = {};
        for (int r = 0; r < rows; ++r) {
            const Wide va = load_wide(row[r] + i);
            const Wide vb = load_wide(row[r] + i + kWide);
            for (int j = 0; j < 4; ++j) {
                const Wide w = fill_wide(weight[4 * r + j]);
                a[j] += w * va;
                b[j] += w * vb;
            }
        }
        for (int j = 0; j < 4; ++j) {
            store_wide(flow[j] + i, a[j]);
            store_wide(flow[j] + i + kWide, b[j]);
        }
    }
    for (; i < nodes; i += 4) {
        Lane a[4] = {};
        for (int r = 0; r < rows; ++r)
            for (int j = 0; j < 4; ++j)
                a[j] += fill(weight[4 * r + j]) * load(row[r] + i);
        for (int j = 0; j < 4; ++j)
            store(flow[j] + i, a[j]);
    }
}

void lean(int nodes, const double* area, const double* along_area, const double* point,
          const double* centre, const double* along_way, double* out) {
    const Lane middle = load(centre);
    for (int i = 0; i < nodes; ++i)
        store(out + 4 * i, without_w(fill(along_area[i]) * load(area + 4 * i) +
                                     fill(along_way[i]) * (load(point + 4 * i) - middle)));
}

void high_pass(int nodes, const double* in, double keep, double pass, double* before, double* after,
               double extra, const double* share, double* out) {
    const Lane k = fill(keep), p = fill(pass), e = fill(extra);
    for (int i = 0; i < nodes; i += 4) {
        const Lane now = load(in + i);
        const Lane passed = k * load(after + i) + p * (now - load(before + i));
        store(before + i, now);
        store(after + i, passed);
        store(out + i, passed + e * load(share + i));
    }
}

} // namespace
} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE

#include "dsp/kernel_modes.h"

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {
namespace {

/// Retarded times and weighted values of four nodes at one ear.
struct Arrivals {
    std::int64_t cell[4]; ///< of the ring, where the first tap goes
    std::int64_t row[4];  ///< offset in the splat table of the row that the fraction rounds down to
    double weight[2][4];  ///< of that row and of the next
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
inline void arrive(const SplatSurface& surface, const Aim& ear, int i, Lane& latest,
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
    latest = sane & (when > latest) ? when : latest;

    const Ints whole = truncate(when);
    const Lane place = (when - widen(whole)) * fill(kPhases);
    const Ints phase = truncate(place);
    const Lane next = (place - widen(phase)) * value;
    store(out.weight[0], value - next);
    store(out.weight[1], next);
    store_bits(out.cell, (ear.origin + __builtin_convertvector(whole, Bits)) & ear.mask);
    store_bits(out.row, __builtin_convertvector(phase, Bits) * kTaps);
}

/// One value into the ring of an ear.
inline void put(double* cell, const double* row, double at, double next) {
    for (int j = 0; j < kTaps; j += kWide)
        store_wide(cell + j, load_wide(cell + j) + (fill_wide(at) * load_wide(row + j) +
                                                    fill_wide(next) * load_wide(row + kTaps + j)));
}

/// The number of ears is known here, so that everything stays in registers that can.
template <Facing kFacing, int kEars>
double splat_to(const SplatSurface& surface, const SplatEar* ear) {
    Lane latest{};
    Aim aims[kEars];
    double* ring[kEars][SplatEar::kCopies];
    for (int e = 0; e < kEars; ++e) {
        aims[e] = aim(ear[e]);
        for (int c = 0; c < SplatEar::kCopies; ++c)
            ring[e][c] = ear[e].ring[c];
    }
    const double* const table = surface.table;
    for (int i = 0; i < surface.nodes; i += 4) {
        Arrivals arrival[kEars];
        for (int e = 0; e < kEars; ++e)
            arrive<kFacing>(surface, aims[e], i, latest, arrival[e]);
#pragma GCC unroll 4
        for (int k = 0; k < 4; ++k)
#pragma GCC unroll 2
            for (int e = 0; e < kEars; ++e) {
                const Arrivals& a = arrival[e];
                put(ring[e][k % SplatEar::kCopies] + a.cell[k], table + a.row[k], a.weight[0][k],
                    a.weight[1][k]);
            }
    }
    double last = 0.0;
    for (int k = 0; k < 4; ++k)
        last = latest[k] > last ? latest[k] : last;
    return last;
}

template <Facing kFacing>
double splat(const SplatSurface& surface, const SplatEar* ear, int ears) {
    return ears == 2 ? splat_to<kFacing, 2>(surface, ear) : splat_to<kFacing, 1>(surface, ear);
}

} // namespace
} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE

#include "dsp/kernel_spread.h"

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {

extern const Kernels kKernels;
const Kernels kKernels = {ODE_SOUND_ISA_NAME,
                          &dot,
                          &gather,
                          &between,
                          &areas,
                          &mix,
                          &lean,
                          &high_pass,
                          &differences,
                          &ring,
                          &ring_pushed,
                          &weigh,
                          {&splat<Facing::kAll>, &splat<Facing::kVisible>, &splat<Facing::kCosine>,
                           &splat<Facing::kLeaning>},
                          &spread};

} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE
