// A point's samples on their way to an ear: a part of kernel_bodies.h, which includes it once for
// each instruction set.

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {
namespace {

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

/// A window of taps goes along with the arrivals, so that each cell of the ring is touched once a
/// run: samples that follow one another fall on the same cells, and would wait for each other.
void spread(const SpreadRun& run, const SplatEar& ear) {
    // Delays fall and rise by less than a cell a sample and a sample is two cells or one.
    constexpr int kCells = 4 * SpreadRun::kMost + 2 * kTaps;
    alignas(64) float cell[kCells];
    Window window{};
    const auto begin = static_cast<std::int64_t>(run.delay);
    int at = 0; // cell of the window's first tap
    for (int i = 0; i < run.samples; ++i) {
        const double delay = run.delay + i * (run.pace + i * run.bend);
        const auto whole = static_cast<std::int64_t>(delay);
        const int to = static_cast<int>(i * run.every + whole - begin);
        while (at < to) {
            for (int g = 0; g < kTapGroups; ++g)
                store_floats(cell + at + g * kFloats, window.part[g]);
            if (to - at >= 2) {
                slide<2>(window);
                at += 2;
            } else {
                slide<1>(window);
                ++at;
            }
        }
        const double place = (delay - static_cast<double>(whole)) * kPhases;
        const int phase = static_cast<int>(place);
        const float next = static_cast<float>(place - phase);
        const bool heard = delay >= ear.min_delay && delay <= ear.max_delay;
        const Floats value = Floats{} + (heard ? run.value[i] : 0.0f);
        const float* row = run.table + phase * kTaps;
        for (int g = 0; g < kTapGroups; ++g, row += kFloats) {
            const Floats low = load_floats(row), high = load_floats(row + kTaps);
            window.part[g] += value * (low + next * (high - low));
        }
    }
    for (int g = 0; g < kTapGroups; ++g)
        store_floats(cell + at + g * kFloats, window.part[g]);
    const int cells = at + kTaps;
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
