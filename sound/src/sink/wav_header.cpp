#include "sink/wav_header.h"

#include <cstring>
#include <limits>

namespace ode::sound {
namespace {

/// Bytes of a header in the order of appending.
class Bytes {
public:
    void tag(const char* four) noexcept { put(four, 4); }
    template <class Integer>
    void number(Integer value) noexcept {
        put(&value, sizeof value);
    }
    const std::array<unsigned char, kWavHeaderSize>& all() const noexcept { return byte_; }

private:
    void put(const void* from, std::size_t size) noexcept {
        std::memcpy(byte_.data() + used_, from, size);
        used_ += size;
    }
    std::array<unsigned char, kWavHeaderSize> byte_{};
    std::size_t used_ = 0;
};

} // namespace

std::array<unsigned char, kWavHeaderSize> wav_header(const Format& format, std::uint64_t frames,
                                                     Encoding encoding) noexcept {
    const auto frame_bytes = static_cast<std::uint16_t>(format.channels * sample_bytes(encoding));
    const std::uint64_t data_bytes = frames * frame_bytes;
    const std::uint64_t riff_bytes = data_bytes + kWavHeaderSize - 8;
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
    bytes.number(std::uint32_t{18});
    bytes.number(std::uint16_t{
        encoding == Encoding::kFloat32 ? std::uint16_t{3} : std::uint16_t{1}}); // IEEE float or PCM
    bytes.number(static_cast<std::uint16_t>(format.channels));
    bytes.number(static_cast<std::uint32_t>(format.rate));
    bytes.number(static_cast<std::uint32_t>(format.rate) * frame_bytes);
    bytes.number(frame_bytes);
    bytes.number(static_cast<std::uint16_t>(8 * sample_bytes(encoding)));
    bytes.number(std::uint16_t{0}); // no extension
    bytes.tag("fact");
    bytes.number(std::uint32_t{4});
    bytes.number(low(frames));
    bytes.tag("data");
    bytes.number(low(data_bytes));
    return bytes.all();
}

} // namespace ode::sound
