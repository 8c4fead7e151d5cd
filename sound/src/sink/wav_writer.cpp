// Written here and not by libsndfile, because that cannot leave the PEAK chunk, which holds the
// time of day, out of a file that may grow into RF64: bytes would differ from run to run.
#include "sink/file_writer.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <unistd.h>

namespace ode::sound {
namespace {

static_assert(std::endian::native == std::endian::little, "WAV samples are little-endian");

/// Bytes of a header in the order of appending.
class Bytes {
public:
    static constexpr std::size_t kSize = 12 + (8 + 28) + (8 + 18) + (8 + 4) + 8;

    void tag(const char* four) noexcept { put(four, 4); }
    template <class Integer>
    void number(Integer value) noexcept {
        put(&value, sizeof value);
    }
    const unsigned char* data() const noexcept { return byte_.data(); }

private:
    void put(const void* from, std::size_t size) noexcept {
        std::memcpy(byte_.data() + used_, from, size);
        used_ += size;
    }
    std::array<unsigned char, kSize> byte_{};
    std::size_t used_ = 0;
};

/// The header has one size for RIFF and RF64: a JUNK chunk keeps the place of the 64-bit sizes.
Bytes header(const Format& format, std::uint64_t frames) noexcept {
    const auto frame_bytes = static_cast<std::uint16_t>(format.channels * 4);
    const std::uint64_t data_bytes = frames * frame_bytes;
    const std::uint64_t riff_bytes = data_bytes + Bytes::kSize - 8;
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
    bytes.number(std::uint16_t{3}); // IEEE float
    bytes.number(static_cast<std::uint16_t>(format.channels));
    bytes.number(static_cast<std::uint32_t>(format.rate));
    bytes.number(static_cast<std::uint32_t>(format.rate) * frame_bytes);
    bytes.number(frame_bytes);
    bytes.number(std::uint16_t{32});
    bytes.number(std::uint16_t{0}); // no extension
    bytes.tag("fact");
    bytes.number(std::uint32_t{4});
    bytes.number(low(frames));
    bytes.tag("data");
    bytes.number(low(data_bytes));
    return bytes;
}

class WavWriter final : public FileWriter {
public:
    const char* begin(int descriptor, const Format& format) noexcept override {
        descriptor_ = descriptor;
        format_ = format;
        return checkpoint();
    }

    const char* append(std::span<const float> interleaved) noexcept override {
        const auto* bytes = reinterpret_cast<const unsigned char*>(interleaved.data());
        if (const char* reason = put(bytes, interleaved.size_bytes(), end())) {
            // Cut what came through of a frame; the header then tells of whole frames only.
            [[maybe_unused]] const int cut = ftruncate(descriptor_, static_cast<off_t>(end()));
            checkpoint();
            return reason;
        }
        frames_ += interleaved.size() / static_cast<std::size_t>(format_.channels);
        return nullptr;
    }

    const char* checkpoint() noexcept override {
        const Bytes bytes = header(format_, frames_);
        return put(bytes.data(), Bytes::kSize, 0);
    }
    const char* finish() noexcept override { return checkpoint(); }
    bool clips() const noexcept override { return false; }
    std::uint64_t frames() const noexcept override { return frames_; }

private:
    std::uint64_t end() const noexcept {
        return Bytes::kSize + frames_ * 4 * static_cast<std::uint64_t>(format_.channels);
    }

    /// pwrite(), which may write in parts. What was written of whole frames stays uncounted: the
    /// next append, if any, writes over it.
    const char* put(const unsigned char* from, std::size_t size, std::uint64_t at) noexcept {
        while (size > 0) {
            const ssize_t done = pwrite(descriptor_, from, size, static_cast<off_t>(at));
            if (done < 0 && errno == EINTR)
                continue;
            if (done < 0)
                return std::strerror(errno); // of one thread at a time in glibc
            from += done;
            size -= static_cast<std::size_t>(done);
            at += static_cast<std::uint64_t>(done);
        }
        return nullptr;
    }

    int descriptor_ = -1;
    Format format_{1, 1};
    std::uint64_t frames_ = 0;
};

} // namespace

std::unique_ptr<FileWriter> make_wav_writer() { return std::make_unique<WavWriter>(); }

} // namespace ode::sound
