#pragma once

#include "sink/sink.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ode::sound {

/// RIFF, JUNK or ds64, fmt, fact and the head of the data chunk.
constexpr std::size_t kWavHeaderSize = 12 + (8 + 28) + (8 + 18) + (8 + 4) + 8;

/// What precedes `frames` frames of 32-bit floats: RIFF/WAVE, or RF64 (EBU Tech 3306) where sizes
/// pass 32 bits. The size is the same for both, as a JUNK chunk keeps the place of the 64-bit
/// sizes, so that a growing file's header can be rewritten in place.
std::array<unsigned char, kWavHeaderSize> wav_header(const Format& format,
                                                     std::uint64_t frames) noexcept;

} // namespace ode::sound
