#include "sink/wav_header.h"

#include <cstring>
#include <limits>

namespace ode::sound {
namespace {

/// A header in the making.
struct Bytes {
    WavHeader header;
    void tag(const char* four) noexcept { header.append(four, 4); }
    template <class Integer>
    void number(Integer value) noexcept {
        header.append(&value, sizeof value);
    }
};

/// Of a WAVE_FORMAT_EXTENSIBLE, after its first two bytes, the plain format's number.
constexpr unsigned char kSubformat[14] = {0x00, 0x00, 0x00, 0x00, 0x10, 0x00, 0x80,
                                          0x00, 0x00, 0xAA, 0x00, 0x38, 0x9B, 0x71};

} // namespace

void WavHeader::append(const void* from, std::size_t size) noexcept {
    std::memcpy(byte_.data() + size_, from, size);
    size_ += size;
}

WavHeader wav_header(const Format& format, std::uint64_t frames, Encoding encoding,
                     std::uint32_t speakers) noexcept {
    const bool wide = format.channels > 2 || speakers != 0;
    const std::size_t size = wide ? kWideWavHeaderSize : kWavHeaderSize;
    const auto plain = // IEEE float or PCM
        encoding == Encoding::kFloat32 ? std::uint16_t{3} : std::uint16_t{1};
    const auto bits = static_cast<std::uint16_t>(8 * sample_bytes(encoding));
    const auto frame_bytes = static_cast<std::uint16_t>(format.channels * sample_bytes(encoding));
    const std::uint64_t data_bytes = frames * frame_bytes;
    const std::uint64_t riff_bytes = data_bytes + size - 8;
    constexpr auto kLarge = std::numeric_limits<std::uint32_t>::max(); // "see ds64"
    const bool large = riff_bytes >= kLarge;
    const auto low = [large](std::uint64_t value) {
        return large ? kLarge : static_cast<std::uint32_t>(value);
    };
    Bytes bytes;
    bytes.tag(large ? "RF64" : "RIFF");
    bytes.number(low(riff_bytes));
    bytes.tag("WAVE");
    bytes.tag(large ? "ds64" : "JUNK");
    bytes.number(std::uint32_t{28});
    bytes.number(large ? riff_bytes : 0);
    bytes.number(large ? data_bytes : 0);
    bytes.number(large ? frames : 0);
    bytes.number(std::uint32_t{0}); // no table of further sizes
    bytes.tag("fmt ");
    bytes.number(wide ? std::uint32_t{40} : std::uint32_t{18});
    bytes.number(wide ? std::uint16_t{0xFFFE} : plain);
    bytes.number(static_cast<std::uint16_t>(format.channels));
    bytes.number(static_cast<std::uint32_t>(format.rate));
    bytes.number(static_cast<std::uint32_t>(format.rate) * frame_bytes);
    bytes.number(frame_bytes);
    bytes.number(bits);
    bytes.number(wide ? std::uint16_t{22} : std::uint16_t{0}); // length of the extension
    if (wide) {
        bytes.number(bits); // that count
        bytes.number(speakers);
        bytes.number(plain);
        bytes.header.append(kSubformat, sizeof kSubformat);
    }
    bytes.tag("fact");
    bytes.number(std::uint32_t{4});
    bytes.number(low(frames));
    bytes.tag("data");
    bytes.number(low(data_bytes));
    return bytes.header;
}

} // namespace ode::sound
