#pragma once

#include "sink/file_writer.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ode::sound {

/// RIFF, JUNK or ds64, fmt, fact and the head of the data chunk.
constexpr std::size_t kWavHeaderSize = 12 + (8 + 28) + (8 + 18) + (8 + 4) + 8;

constexpr int sample_bytes(Encoding encoding) noexcept {
    return encoding == Encoding::kFloat32 ? 4 : encoding == Encoding::kInt24 ? 3 : 2;
}

/// What precedes `frames` frames: RIFF/WAVE, or RF64 (EBU Tech 3306) where sizes
/// pass 32 bits. The size is the same for both, as a JUNK chunk keeps the place of the 64-bit
/// sizes, so that a growing file's header can be rewritten in place.
std::array<unsigned char, kWavHeaderSize>
wav_header(const Format& format, std::uint64_t frames,
           Encoding encoding = Encoding::kFloat32) noexcept;

} // namespace ode::sound
