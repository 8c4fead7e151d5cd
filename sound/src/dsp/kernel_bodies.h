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
#include "dsp/kernel_waves.h"

#include "dsp/kernel_splat.h"
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
                          &by_degree,
                          {&splat<Facing::kAll>, &splat<Facing::kVisible>, &splat<Facing::kCosine>,
                           &splat<Facing::kLeaning>},
                          &spread};

} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE
