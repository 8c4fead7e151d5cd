#pragma once

#include "sink/file_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace ode::sound {

/// Full scale to integers: rounded, clipped, not-a-number is silence. See Encoding.
class Quantiser {
public:
    explicit Quantiser(Encoding encoding) noexcept
        : most_(encoding == Encoding::kInt16 ? 32768.0 : 8388608.0),
          dither_(encoding == Encoding::kInt16) {}

    std::int32_t operator()(float sample) noexcept {
        double x = static_cast<double>(sample) * most_;
        if (x == 0.0) // digital silence stays so
            return 0;
        if (dither_)
            x += uniform() - uniform();
        return x == x ? static_cast<std::int32_t>(std::lrint(std::clamp(x, -most_, most_ - 1.0)))
                      : 0;
    }

    /// Little-endian, packed.
    void write(std::span<const float> from, unsigned char* to) noexcept {
        for (const float sample : from) {
            const auto bits = static_cast<std::uint32_t>((*this)(sample));
            *to++ = static_cast<unsigned char>(bits);
            *to++ = static_cast<unsigned char>(bits >> 8);
            if (!dither_)
                *to++ = static_cast<unsigned char>(bits >> 16);
        }
    }

private:
    double uniform() noexcept { // PCG's generator of 32 bits, its upper half
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state_ >> 32) * 0x1p-32;
    }

    double most_; ///< steps in full scale
    bool dither_;
    std::uint64_t state_ = 1;
};

} // namespace ode::sound
