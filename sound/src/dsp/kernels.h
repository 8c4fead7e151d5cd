#pragma once

#include <cstdint>
#include <span>

namespace ode::sound {

// The inner loops of the sound path, compiled once for each instruction set and chosen at run time.
// Points are stored x y z w, four doubles each; w is ignored where read and 0 where written. Node
// counts are multiples of four: the last node is repeated with area zero.

/// How loud a node of a surface is in a direction.
enum class Facing {
    kAll,     ///< the same all round
    kVisible, ///< 1 where its normal looks at the ear, 0 where away, a ramp of cos = +-0.05 between
    kCosine,  ///< cosine of the angle between normal and ear where positive, else 0
    kLeaning  ///< flow + lean_flow (lean . way) / distance
};

/// One ear, as one sample of one surface is sent to it.
struct SplatEar {
    static constexpr int kCopies = 2;
    double position[4];    ///< [m]
    double mach[4];        ///< its velocity over the speed of sound, length < 1
    double* ring[kCopies]; ///< accumulators, added together by the reader; neighbouring nodes
                           ///< alternate, so that their read-modify-writes do not wait
    std::int64_t mask;     ///< ring length - 1, a power of two; kTaps more cells lie behind
    std::int64_t sample;   ///< index in the ring's time of the sample sent
    double gain;           ///< of this sample at this ear
    double min_delay;      ///< delays below this or above max_delay are dropped [samples]
    double max_delay;
};

struct SplatSurface {
    int nodes;
    const double* position;   ///< points [m]
    const double* area;       ///< area vectors, points [m^2]; unused for Facing::kAll
    const double* softening;  ///< square of the least distance of each node [m^2]
    const double* flow;       ///< volume per time of each node [m^3/s]
    const double* lean;       ///< points [-], for Facing::kLeaning
    const double* lean_flow;  ///< of each node [m^3/s], the same
    double samples_per_metre; ///< ring rate / speed of sound
    const double* table;      ///< SplatTable::rows()
    const double* moment;     ///< SplatTable::moments()
};

/// One point at successive samples, on its way to one ear.
struct SpreadRun {
    static constexpr int kMost = 80; ///< samples
    int samples;
    int every; ///< cells of the ring from one sample to the next
    const float* value;
    double delay, pace, bend; ///< of sample i: delay + i (pace + i bend) [cells]
    const float* table;       ///< SplatTable::float_rows()
};

/// Oscillators are stored as rows of floats, in whole numbers of this many.
constexpr int kModeLanes = 16;

/// What pushes oscillators while they swing.
struct RingPush {
    const float* series; ///< share of it in each sample
    const float* q;      ///< what all of it gives q; null: nothing
    const float* v;      ///< and q'
    int columns;         ///< those after are not pushed; whole numbers of kModeLanes
    int begin, end;      ///< samples in which the share is not zero
};

constexpr int kMostPushes = 136;

struct Kernels {
    const char* name;

    /// sum of a[i] b[i]; n a multiple of four.
    double (*dot)(const double* a, const double* b, int n);

    /// volume[i] = area[i] . (position[node[i]] - last[i]), then last[i] = position[node[i]].
    void (*gather)(int nodes, const int* node, const double* position, int stride,
                   const double* area, double* last, double* volume);

    /// place[i] = last[i] + fraction (position[node[i]] - last[i]).
    void (*between)(int nodes, const int* node, const double* position, int stride,
                    const double* last, double fraction, double* place);

    /// area[i] += (x1 - x0) x (x2 - x0) / 6 for the three nodes i of each triangle.
    void (*areas)(int triangles, const int* triangle, const double* point, double* area);

    /// flow[j][i] = sum over rows r of weight[4 r + j] row[r][i], for j = 0..3.
    void (*mix)(int nodes, int rows, const double* const* row, const double* weight,
                double* const* flow);

    /// out[i] = along_area[i] area[i] + along_way[i] (point[i] - centre).
    void (*lean)(int nodes, const double* area, const double* along_area, const double* point,
                 const double* centre, const double* along_way, double* out);

    /// after[i] = keep after[i] + pass (in[i] - before[i]), before[i] = in[i];
    /// out[i] = after[i] + extra share[i].
    void (*high_pass)(int nodes, const double* in, double keep, double pass, double* before,
                      double* after, double extra, const double* share, double* out);

    /// Of the third differences a_i of row[i] .. row[i + 3], i = 0..4: own[i] = a_i . a_i and
    /// next[i] = a_i . a_(i+1), i = 0..3; nodes a multiple of four.
    void (*differences)(int nodes, const double* const row[8], double own[4], double next[4]);

    /// Oscillators over `samples` samples, each by q += a q + b v, v += c q + d v (both of the old
    /// q and v): rows a, b, c, d of `step`, `stride` apart. Changes are what is stored, so that
    /// floats keep slow decays. @param q, v  state, left as after the last sample.
    /// @param q_rows, v_rows  out: the state after each sample, a row each.
    void (*ring)(int columns, int samples, const float* step, int stride, float* q, float* v,
                 float* q_rows, float* v_rows);

    /// The same while they are pushed, after each sample's step; by kMostPushes at most.
    void (*ring_pushed)(int columns, int samples, const float* step, int stride, float* q, float* v,
                        float* q_rows, float* v_rows, const RingPush* push, int pushes);

    /// out[e][s] = sum over the columns of by[e][0] q_rows[s] + by[e][1] v_rows[s], for e below
    /// `sums`, which is 1, 2 or 4.
    void (*weigh)(int columns, int samples, int sums, const float* const (*by)[2],
                  const float* q_rows, const float* v_rows, float* const* out);

    /// Sums of real and imaginary parts of coefficients times harmonics, degree by degree: of
    /// degree l those at l^2 .. (l + 1)^2. Pairs of floats all three; harmonics come twice each.
    void (*by_degree)(int order, const float* coefficient, const float* harmonic, float* sum);

    /// Adds flow / distance of every node to the rings of the ears at the retarded time.
    /// @return largest delay that was not dropped [samples]; 0 if all were.
    double (*splat[4])(const SplatSurface& surface, const SplatEar* ear, int ears);

    /// Adds every value to the ring of an ear after its delay; ear.gain, position and mach don't
    /// count. Delays must not fall by as much as `every` from one sample to the next.
    void (*spread)(const SpreadRun& run, const SplatEar& ear);
};

/// The widest set that this processor runs, or the one that the environment variable ODE_SOUND_ISA
/// (baseline, avx2, avx512) names. Sets differ in rounding; one set gives the same bits every time.
const Kernels& kernels() noexcept;

/// All sets that this processor runs, the portable one first.
std::span<const Kernels* const> all_kernels() noexcept;

} // namespace ode::sound
