// A point's samples on their way to an ear: a part of kernel_bodies.h, which includes it once for
// each instruction set.

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {
namespace {

using WideInts [[gnu::vector_size(4 * kWide)]] = std::int32_t;
using WideFloats [[gnu::vector_size(4 * kWide)]] = float;

inline Wide ascending() {
    Wide out{};
    for (int i = 0; i < kWide; ++i)
        out[i] = i;
    return out;
}

/// The taps of one sample, in registers.
constexpr int kTapGroups = kTaps / kFloats;
struct Window {
    Floats part[kTapGroups];
};

template <int kShift, int... kLane>
inline Floats later(const Floats& now, const Floats& next, std::integer_sequence<int, kLane...>) {
    using Index [[gnu::vector_size(4 * kFloats)]] = std::int32_t;
    return __builtin_shuffle(now, next, Index{(kLane + kShift)...});
}

/// What has left on the left is done with.
template <int kShift>
inline void slide(Window& window) {
    for (int g = 0; g < kTapGroups; ++g)
        window.part[g] =
            later<kShift>(window.part[g], g + 1 < kTapGroups ? window.part[g + 1] : Floats{},
                          std::make_integer_sequence<int, kFloats>());
}

/// A window of taps goes along with the arrivals, so that each cell of the ring is touched once:
/// samples that follow one another fall on the same cells, and would wait for each other.
struct Along {
    Window window{};
    float* cell; // of the window's first tap

    void go(float* to) {
        while (cell < to) {
            for (int g = 0; g < kTapGroups; ++g)
                store_floats(cell + g * kFloats, window.part[g]);
            if (to - cell >= 2) {
                slide<2>(window);
                cell += 2;
            } else {
                slide<1>(window);
                ++cell;
            }
        }
    }
    void add(float value, const float* row, float next) {
        const Floats all = Floats{} + value;
        for (int g = 0; g < kTapGroups; ++g, row += kFloats) {
            const Floats low = load_floats(row), high = load_floats(row + kTaps);
            window.part[g] += all * (low + next * (high - low));
        }
    }
    void end() {
        for (int g = 0; g < kTapGroups; ++g)
            store_floats(cell + g * kFloats, window.part[g]);
    }
};

/// Two halves of the run go side by side, since each sample waits for the one before.
void spread(const SpreadRun& run, const SplatEar& ear) {
    // Delays fall and rise by less than a cell a sample and a sample is two cells or one.
    constexpr int kCells = 4 * SpreadRun::kMost + 2 * kTaps;
    alignas(64) float cell[kCells], later[kCells];
    static_assert(SpreadRun::kMost % kWide == 0);
    alignas(64) std::int32_t where[SpreadRun::kMost], row[SpreadRun::kMost];
    alignas(64) float next[SpreadRun::kMost], value[SpreadRun::kMost];
    const auto begin = static_cast<int>(run.delay);
    Wide sample = ascending();
    for (int i = 0; i < SpreadRun::kMost; i += kWide, sample += static_cast<double>(kWide)) {
        const Wide delay = run.delay + sample * (run.pace + sample * run.bend);
        const WideInts whole = __builtin_convertvector(delay, WideInts);
        const Wide place = (delay - __builtin_convertvector(whole, Wide)) * double{kPhases};
        const WideInts phase = __builtin_convertvector(place, WideInts);
        const WideInts cells =
            __builtin_convertvector(sample * static_cast<double>(run.every), WideInts);
        const WideFloats part =
            __builtin_convertvector(place - __builtin_convertvector(phase, Wide), WideFloats);
        const WideInts to = cells + whole - begin, taps = phase * kTaps;
        __builtin_memcpy(where + i, &to, sizeof to);
        __builtin_memcpy(row + i, &taps, sizeof taps);
        __builtin_memcpy(next + i, &part, sizeof part);
    }
    const auto delay_of = [&](int i) { return run.delay + i * (run.pace + i * run.bend); };
    const double bow = __builtin_fabs(run.bend) * run.samples * run.samples;
    const double ends[2] = {run.delay, delay_of(run.samples - 1)};
    const bool all = __builtin_fmin(ends[0], ends[1]) - bow >= ear.min_delay &&
                     __builtin_fmax(ends[0], ends[1]) + bow <= ear.max_delay;
    for (int i = 0; i < run.samples; ++i)
        value[i] = all || (delay_of(i) >= ear.min_delay && delay_of(i) <= ear.max_delay)
                       ? run.value[i]
                       : 0.0f;
    const int half = run.samples / 2, middle = where[half];
    Along first{{}, cell}, second{{}, later};
    for (int i = 0, j = half; j < run.samples; ++i, ++j) {
        second.go(later + (where[j] - middle));
        second.add(value[j], run.table + row[j], next[j]);
        if (i < half) {
            first.go(cell + where[i]);
            first.add(value[i], run.table + row[i], next[i]);
        }
    }
    first.end();
    second.end();
    // What the first half leaves and the second begins with falls on the same cells.
    const auto reached = static_cast<int>(first.cell - cell) + (half > 0 ? kTaps : 0);
    const int cells = middle + static_cast<int>(second.cell - later) + kTaps;
    for (int k = reached; k < cells; ++k)
        cell[k] = 0.0f;
    for (int k = middle; k < cells; ++k)
        cell[k] += later[k - middle];
    // The ring is longer than any run; what runs over its end belongs to its beginning.
    std::int64_t to = (ear.sample - kBefore + begin) & ear.mask;
    for (int done = 0; done < cells;) {
        const auto left = static_cast<int>(ear.mask + 1 - to);
        const int count = cells - done < left ? cells - done : left;
        double* const ring = ear.ring[0] + to;
        for (int k = 0; k < count; ++k)
            ring[k] += static_cast<double>(cell[done + k]);
        done += count;
        to = 0;
    }
}

} // namespace
} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE
