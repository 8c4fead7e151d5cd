#include "dsp/kernels.h"

#include "dsp/splat_table.h"
#include "dsp/storage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace ode::sound {
namespace {

constexpr int kNodes = 44; // not a multiple of any wide width but four

double noise(int i) { return std::sin(12.9898 * i) * 3.7 - std::cos(3.1 * i * i); }

AlignedVector points(int seed) {
    AlignedVector p(4 * kNodes);
    for (int i = 0; i < 4 * kNodes; ++i)
        p[static_cast<std::size_t>(i)] = i % 4 == 3 ? 0.0 : noise(i + seed);
    return p;
}

class EveryKernel : public testing::TestWithParam<const Kernels*> {
protected:
    const Kernels& kernel = *GetParam();
};

TEST_P(EveryKernel, DotIsASum) {
    const AlignedVector a = points(1), b = points(2);
    double expected = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        expected += a[i] * b[i];
    EXPECT_NEAR(kernel.dot(a.data(), b.data(), 4 * kNodes), expected, 1e-11);
}

TEST_P(EveryKernel, GatherProjectsDisplacementAndKeepsPlace) {
    AlignedVector now = points(3), last = points(4);
    const AlignedVector area = points(5), before = last;
    now[3] = std::nan(""); // padding is anything
    std::vector<int> node(kNodes);
    for (int i = 0; i < kNodes; ++i)
        node[static_cast<std::size_t>(i)] = (7 * i) % kNodes;
    AlignedVector volume(kNodes);
    kernel.gather(kNodes, node.data(), now.data(), 4, area.data(), last.data(), volume.data());
    for (std::size_t i = 0; i < kNodes; ++i) {
        const std::size_t from = 4 * static_cast<std::size_t>(node[i]);
        double expected = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            expected += area[4 * i + k] * (now[from + k] - before[4 * i + k]);
            EXPECT_EQ(last[4 * i + k], now[from + k]);
        }
        EXPECT_EQ(last[4 * i + 3], 0.0);
        EXPECT_NEAR(volume[i], expected, 1e-13 * 100.0);
    }
}

TEST_P(EveryKernel, MixIsAMatrixProduct) {
    constexpr int kRows = 5;
    std::vector<AlignedVector> row;
    const double* at[kRows];
    std::vector<double> weight;
    for (int r = 0; r < kRows; ++r) {
        row.push_back(points(10 + r));
        for (int j = 0; j < 4; ++j)
            weight.push_back(noise(100 + 4 * r + j));
    }
    for (std::size_t r = 0; r < kRows; ++r)
        at[r] = row[r].data();
    AlignedVector out(4 * kNodes);
    double* flow[4];
    for (int j = 0; j < 4; ++j)
        flow[j] = out.data() + j * kNodes;
    kernel.mix(kNodes, kRows, at, weight.data(), flow);
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < kNodes; ++i) {
            double expected = 0.0;
            for (std::size_t r = 0; r < kRows; ++r)
                expected += weight[4 * r + j] * row[r][i];
            EXPECT_NEAR(flow[j][i], expected, 1e-12);
        }
}

/// One node of flow 1 m^3/s at the origin; three silent companions.
struct Point {
    AlignedVector position = AlignedVector(16, 0.0);
    AlignedVector area = AlignedVector(16, 0.0);
    AlignedVector softening = AlignedVector(4, 1e-12);
    AlignedVector flow = AlignedVector(4, 0.0);
    AlignedVector lean = AlignedVector(16, 0.0);
    AlignedVector lean_flow = AlignedVector(4, 0.0);
    std::vector<double> ring[2];
    SplatEar ear{};

    explicit Point(double x) {
        flow[0] = 1.0;
        for (auto& r : ring)
            r.assign(1024 + 16, 0.0);
        ear = {{x, 0.0, 0.0, 0.0},
               {0.0, 0.0, 0.0, 0.0},
               {ring[0].data(), ring[1].data()},
               1023,
               100,
               1.0,
               0.0,
               500.0};
    }
    SplatSurface surface() const {
        return {4,
                position.data(),
                area.data(),
                softening.data(),
                flow.data(),
                lean.data(),
                lean_flow.data(),
                280.0,
                splat_table().rows(),
                splat_table().moments()};
    }
    double sum() const {
        double s = 0.0;
        for (const auto& r : ring)
            for (const double v : r)
                s += v;
        return s;
    }
    double centroid() const {
        double s = 0.0;
        for (const auto& r : ring)
            for (std::size_t i = 0; i < r.size(); ++i)
                s += static_cast<double>(i) * r[i];
        return s / sum();
    }
};

TEST_P(EveryKernel, SplatLandsAtTheRetardedTime) {
    for (const double x : {0.1, 0.5, 0.7301, 1.2345}) {
        Point p(x);
        const double last = kernel.splat[0](p.surface(), &p.ear, 1);
        EXPECT_NEAR(last, 280.0 * x, 1e-6);
        EXPECT_NEAR(p.sum(), 1.0 / x, 1e-9 / x); // rows sum to one
        EXPECT_NEAR(p.centroid(), 100.0 + 280.0 * x, 2e-3);
    }
}

TEST_P(EveryKernel, SplatAimsAtWhereTheEarWillBe) {
    Point p(0.5);
    p.ear.mach[0] = 0.2; // flees: c T = 0.5 + 0.2 c T
    kernel.splat[0](p.surface(), &p.ear, 1);
    EXPECT_NEAR(p.sum(), 0.8 / 0.5, 1e-6);
    EXPECT_NEAR(p.centroid(), 100.0 + 280.0 * 0.5 / 0.8, 2e-3);
}

TEST_P(EveryKernel, SplatDropsWhatCannotBeKept) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300}) {
        Point flow(0.5);
        flow.flow[0] = bad;
        kernel.splat[0](flow.surface(), &flow.ear, 1);
        EXPECT_EQ(flow.sum(), 0.0);
        Point place(0.5);
        place.position[1] = bad;
        kernel.splat[0](place.surface(), &place.ear, 1);
        EXPECT_EQ(place.sum(), 0.0);
    }
    Point far(100.0);
    EXPECT_EQ(kernel.splat[0](far.surface(), &far.ear, 1), 0.0);
    EXPECT_EQ(far.sum(), 0.0);
}

/// Nodes about a place `away` from an ear, within `size` [m].
struct Cloud {
    static constexpr int kMany = 1300; ///< not a whole number of chunks
    AlignedVector position = AlignedVector(4 * kMany, 0.0), area = position, lean = position;
    AlignedVector softening = AlignedVector(kMany, 1e-12), flow = AlignedVector(kMany);
    AlignedVector lean_flow = AlignedVector(kMany, 0.0);
    std::vector<double> ring[2][2];
    SplatEar ear[2];

    Cloud(double size, double away) {
        for (int i = 0; i < kMany; ++i) {
            const auto at = static_cast<std::size_t>(i);
            flow[at] = noise(i);
            for (int k = 0; k < 3; ++k)
                position[4 * at + static_cast<std::size_t>(k)] =
                    0.5 * size * noise(9000 + 3 * i + k);
        }
        for (int e = 0; e < 2; ++e) {
            for (auto& r : ring[e])
                r.assign(1024 + 16, 0.0);
            ear[e] = {{away, 0.1 * e, 0.0, 0.0},
                      {0.01, 0.0, 0.0, 0.0},
                      {ring[e][0].data(), ring[e][1].data()},
                      1023,
                      900, // over the ring's end
                      1.0,
                      0.0,
                      500.0};
        }
    }
    SplatSurface nodes(int first, int count) const {
        return {count,
                position.data() + 4 * first,
                area.data() + 4 * first,
                softening.data() + first,
                flow.data() + first,
                lean.data() + 4 * first,
                lean_flow.data() + first,
                280.0,
                splat_table().rows(),
                splat_table().moments()};
    }
    /// What the ear's line will read.
    std::vector<double> heard(int e) const {
        std::vector<double> out(1024);
        for (const auto& r : ring[e])
            for (std::size_t i = 0; i < r.size(); ++i)
                out[i % 1024] += r[i];
        return out;
    }
};

// Arrivals of like delay are summed before they are spread; four nodes far apart never are.
TEST_P(EveryKernel, SumsOfArrivalsAreTheArrivals) {
    for (const double size : {0.01, 0.2, 0.6, 1.4}) { // 1.4 m are more cells than are summed
        Cloud all(size, 0.9), alone(size, 0.9);
        alone.flow[7] = all.flow[7] = std::nan(""); // is left out, wherever it seems to be
        const double last = kernel.splat[0](all.nodes(0, Cloud::kMany), all.ear, 2);
        double latest = 0.0;
        for (int i = 0; i < Cloud::kMany; ++i) {
            // One node and three silent ones half a metre apart.
            SplatSurface one = alone.nodes(i, 4);
            AlignedVector place(16, 0.0), flow(4, 0.0);
            for (std::size_t k = 0; k < 3; ++k)
                place[k] = alone.position[4 * static_cast<std::size_t>(i) + k];
            for (std::size_t n = 1; n < 4; ++n)
                place[4 * n] = 0.4 * (static_cast<double>(n) - 2.5);
            flow[0] = alone.flow[static_cast<std::size_t>(i)];
            one.position = place.data();
            one.flow = flow.data();
            one.softening = alone.softening.data();
            latest = std::max(latest, kernel.splat[0](one, alone.ear, 2));
        }
        EXPECT_GT(latest, last - 1e-9);
        for (int e = 0; e < 2; ++e) {
            const std::vector<double> a = all.heard(e), b = alone.heard(e);
            double energy = 0.0, error = 0.0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                energy += b[i] * b[i];
                error += (a[i] - b[i]) * (a[i] - b[i]);
            }
            EXPECT_GT(energy, 0.0);
            EXPECT_LT(std::sqrt(error / energy), 3e-5)
                << size << " m"; // noise up to half the grid's rate
        }
    }
}

TEST_P(EveryKernel, FacingWeighsByTheNormal) {
    for (const double cosine : {1.0, 0.5, 0.01, -0.01, -0.5}) {
        for (const Facing facing : {Facing::kVisible, Facing::kCosine}) {
            Point p(0.5);
            p.area[0] = 3e-4 * cosine;
            p.area[1] = 3e-4 * std::sqrt(1.0 - cosine * cosine);
            kernel.splat[static_cast<int>(facing)](p.surface(), &p.ear, 1);
            const double expected = facing == Facing::kCosine
                                        ? std::max(cosine, 0.0)
                                        : std::clamp(0.5 + 10.0 * cosine, 0.0, 1.0);
            EXPECT_NEAR(p.sum(), 2.0 * expected, 1e-9);
        }
    }
}

TEST_P(EveryKernel, LeaningAddsTheLeanTowardsTheEar) {
    Point p(0.5);
    p.lean[0] = 3.0;
    p.lean[1] = 100.0; // across the way: not heard
    p.lean_flow[0] = 0.2;
    kernel.splat[static_cast<int>(Facing::kLeaning)](p.surface(), &p.ear, 1);
    EXPECT_NEAR(p.sum(), (1.0 + 3.0 * 0.2) / 0.5, 1e-8);
}

TEST_P(EveryKernel, LeanIsMadeOfAreaAndWay) {
    const AlignedVector area = points(1), point = points(2), a = points(3), b = points(4);
    const double centre[4] = {0.3, -0.2, 0.7, 0.0};
    AlignedVector out(4 * kNodes, 9.0);
    kernel.lean(kNodes, area.data(), a.data(), point.data(), centre, b.data(), out.data());
    for (std::size_t i = 0; i < kNodes; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_NEAR(out[4 * i + k],
                        k < 3 ? a[i] * area[4 * i + k] + b[i] * (point[4 * i + k] - centre[k])
                              : 0.0,
                        1e-12);
}

TEST_P(EveryKernel, HighPassIsItsRecurrence) {
    const AlignedVector share = points(7);
    AlignedVector before(kNodes, 0.0), after(before), out(before);
    std::vector<double> x(kNodes, 0.0), y(x);
    for (int n = 0; n < 5; ++n) {
        const AlignedVector in = points(20 + n);
        kernel.high_pass(kNodes, in.data(), 0.7, 0.85, before.data(), after.data(), 0.1 * n,
                         share.data(), out.data());
        for (std::size_t i = 0; i < kNodes; ++i) {
            y[i] = 0.7 * y[i] + 0.85 * (in[i] - x[i]);
            x[i] = in[i];
            EXPECT_NEAR(out[i], y[i] + 0.1 * n * share[i], 1e-12);
        }
    }
}
TEST_P(EveryKernel, SumsByDegree) {
    constexpr int kOrder = 13;
    constexpr std::size_t kCount = 2 * (kOrder + 1) * (kOrder + 1);
    std::vector<float> a(kCount), y(kCount), sum(2 * (kOrder + 1)); // nothing beyond their ends
    for (std::size_t i = 0; i < kCount; ++i) {
        a[i] = static_cast<float>(noise(static_cast<int>(i)));
        y[i] = static_cast<float>(noise(static_cast<int>(i / 2) + 900));
    }
    kernel.by_degree(kOrder, a.data(), y.data(), sum.data());
    for (std::size_t l = 0; l <= kOrder; ++l)
        for (std::size_t part = 0; part < 2; ++part) {
            double expected = 0.0;
            for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i)
                expected += static_cast<double>(a[2 * i + part]) * static_cast<double>(y[2 * i]);
            EXPECT_NEAR(sum[2 * l + part], expected, 1e-5) << l;
        }
}

// What slides along in registers is what every sample puts down by itself.
TEST_P(EveryKernel, SpreadPutsEverySampleAtItsDelay) {
    constexpr int kRing = 1024;
    for (const double pace : {0.0, 0.03, -0.04, 0.9, -1.1}) {
        AlignedVector ring(kRing + SplatTable::kTaps), expected(kRing + SplatTable::kTaps);
        SpreadRun run{};
        run.samples = SpreadRun::kMost;
        run.every = 2;
        std::vector<float> value(SpreadRun::kMost);
        for (int i = 0; i < run.samples; ++i)
            value[static_cast<std::size_t>(i)] = static_cast<float>(noise(i));
        run.value = value.data();
        run.delay = 153.37;
        run.pace = pace;
        run.bend = 1e-3;
        run.table = splat_table().float_rows();
        SplatEar ear{};
        ear.ring[0] = ring.data();
        ear.mask = kRing - 1;
        ear.sample = 800; // beyond the ring's end on the way
        ear.min_delay = 0;
        ear.max_delay = 190;
        kernel.spread(run, ear);
        for (int i = 0; i < run.samples; ++i) {
            const double delay = run.delay + i * (run.pace + i * run.bend);
            if (delay > ear.max_delay)
                continue;
            const int whole = static_cast<int>(delay);
            const double place = (delay - whole) * SplatTable::kPhases;
            const int phase = static_cast<int>(place);
            const double* row = splat_table().rows() + phase * SplatTable::kTaps;
            for (int j = 0; j < SplatTable::kTaps; ++j) {
                const int cell = 800 + 2 * i + whole - SplatTable::kBefore + j;
                const double weight =
                    row[j] + (place - phase) * (row[j + SplatTable::kTaps] - row[j]);
                expected[static_cast<std::size_t>(cell & (kRing - 1))] +=
                    weight * static_cast<double>(value[static_cast<std::size_t>(i)]);
            }
        }
        for (std::size_t i = 0; i < kRing; ++i)
            EXPECT_NEAR(ring[i], expected[i], 3e-6) << pace << ", " << i; // floats of 5
    }
}

INSTANTIATE_TEST_SUITE_P(Sets, EveryKernel,
                         testing::ValuesIn(all_kernels().begin(), all_kernels().end()),
                         [](const auto& set) { return std::string(set.param->name); });

} // namespace
} // namespace ode::sound
