#pragma once

#include "sink/file_writer.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace ode::sound {

/// RIFF, JUNK or ds64, fmt, fact and the head of the data chunk.
constexpr std::size_t kWavHeaderSize = 12 + (8 + 28) + (8 + 18) + (8 + 4) + 8;
/// With the extension of fmt (WAVE_FORMAT_EXTENSIBLE), which more than two channels must have.
constexpr std::size_t kWideWavHeaderSize = kWavHeaderSize + 22;

/// A header's bytes.
class WavHeader {
public:
    const unsigned char* data() const noexcept { return byte_.data(); }
    std::size_t size() const noexcept { return size_; }
    void append(const void* from, std::size_t size) noexcept;

private:
    std::array<unsigned char, kWideWavHeaderSize> byte_{};
    std::size_t size_ = 0;
};

constexpr int sample_bytes(Encoding encoding) noexcept {
    return encoding == Encoding::kFloat32 ? 4 : encoding == Encoding::kInt24 ? 3 : 2;
}

/// What precedes `frames` frames: RIFF/WAVE, or RF64 (EBU Tech 3306) where sizes
/// pass 32 bits. The size is the same for both, as a JUNK chunk keeps the place of the 64-bit
/// sizes, so that a growing file's header can be rewritten in place.
/// @param speakers  a bit for each channel's loudspeaker, in WAVE_FORMAT_EXTENSIBLE's order; 0:
///                  channels are microphones, meant for no loudspeaker.
WavHeader wav_header(const Format& format, std::uint64_t frames,
                     Encoding encoding = Encoding::kFloat32, std::uint32_t speakers = 0) noexcept;

} // namespace ode::sound
