#include "path/ear_line.h"

#include "dsp/splat_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ode::sound {

EarLine::EarLine(double rate, std::int64_t frame, const Decimator& decimator,
                 std::optional<DcBlock> block)
    : decimator_(decimator), block_(block), pulled_(2 * frame - decimator.reach()),
      latest_(pulled_) {
    const auto cells =
        std::bit_ceil(static_cast<std::size_t>(std::ceil(2.0 * rate * kLongestDelay)));
    mask_ = static_cast<std::int64_t>(cells) - 1;
    for (AlignedVector& copy : ring_)
        copy.assign(cells + SplatTable::kTaps, 0.0);
    // The decimator's taps are padded to a multiple of four: it reads up to three zeros more.
    window_.assign(static_cast<std::size_t>(2 * decimator.reach() + 2 * kBlock + 4), 0.0);
}

SplatEar EarLine::target(std::int64_t sample) noexcept {
    SplatEar ear{};
    for (int c = 0; c < SplatEar::kCopies; ++c)
        ear.ring[c] = ring_[c].data();
    ear.mask = mask_;
    ear.sample = sample;
    // The first tap must not fall before what has been read, nor the last behind what is kept.
    ear.min_delay = std::max(0.0, static_cast<double>(pulled_ + SplatTable::kBefore - sample));
    ear.max_delay = static_cast<double>(pulled_ + mask_ - SplatTable::kAfter - 1 - sample);
    return ear;
}

void EarLine::note_arrival(double arrival) noexcept {
    latest_ = std::max(latest_, static_cast<std::int64_t>(arrival) + SplatTable::kAfter + 1);
}

int EarLine::lookahead(double rate) noexcept {
    return Decimator::reach_for(rate) + SplatTable::kBefore + 1;
}

std::int64_t EarLine::last_frame() const noexcept { return (latest_ + decimator_.reach() + 1) / 2; }

double EarLine::pull() noexcept {
    const auto cell = static_cast<std::size_t>(pulled_++ & mask_);
    const std::size_t over = static_cast<std::size_t>(mask_) + 1 + cell;
    double value = 0.0;
    for (AlignedVector& copy : ring_) {
        value += copy[cell];
        copy[cell] = 0.0;
        if (cell < SplatTable::kTaps) { // what ran over the ring's end belongs to its beginning
            value += copy[over];
            copy[over] = 0.0;
        }
    }
    return value;
}

void EarLine::read(int frames, double* out) noexcept {
    while (frames > 0) {
        const int count = std::min(frames, kBlock);
        const auto needed = static_cast<std::size_t>(2 * (count - 1) + 2 * decimator_.reach() + 1);
        while (held_ < needed)
            window_[held_++] = pull();
        for (int f = 0; f < count; ++f)
            out[f] = decimator_(window_.data() + 2 * f);
        if (block_)
            for (int f = 0; f < count; ++f)
                out[f] = (*block_)(out[f]);
        const auto done = static_cast<std::size_t>(2 * count);
        // The window ends one sample short of the next frame's: done <= held_ unless reach is 0.
        std::copy(window_.begin() + static_cast<std::ptrdiff_t>(done),
                  window_.begin() + static_cast<std::ptrdiff_t>(held_), window_.begin());
        held_ -= done;
        frames -= count;
        out += count;
    }
}

} // namespace ode::sound
