// Written here and not by libsndfile, because that cannot leave the PEAK chunk, which holds the
// time of day, out of a file that may grow into RF64: bytes would differ from run to run.
#include "sink/file_writer.h"
#include "sink/quantiser.h"
#include "sink/wav_header.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace ode::sound {
namespace {

static_assert(std::endian::native == std::endian::little, "WAV samples are little-endian");

class WavWriter final : public FileWriter {
public:
    WavWriter(Encoding encoding, std::uint32_t speakers)
        : encoding_(encoding), speakers_(speakers), quantiser_(encoding) {}

    const char* begin(int descriptor, const Format& format) noexcept override {
        descriptor_ = descriptor;
        format_ = format;
        return checkpoint();
    }

    const char* append(std::span<const float> interleaved) noexcept override {
        const auto channels = static_cast<std::size_t>(format_.channels);
        const char* reason = nullptr;
        if (encoding_ == Encoding::kFloat32) {
            reason = put(reinterpret_cast<const unsigned char*>(interleaved.data()),
                         interleaved.size_bytes(), end());
            frames_ += reason ? 0 : interleaved.size() / channels;
        }
        while (encoding_ != Encoding::kFloat32 && !reason && interleaved.size() >= channels) {
            const std::size_t part =
                std::min(interleaved.size() / channels, kBlock / channels) * channels;
            unsigned char bytes[3 * kBlock];
            quantiser_.write(interleaved.first(part), bytes);
            reason = put(bytes, part * static_cast<std::size_t>(sample_bytes(encoding_)), end());
            frames_ += reason ? 0 : part / channels;
            interleaved = interleaved.subspan(part);
        }
        if (reason) {
            // Cut what came through of a frame; the header then tells of whole frames only.
            [[maybe_unused]] const int cut = ftruncate(descriptor_, static_cast<off_t>(end()));
            checkpoint();
        }
        return reason;
    }

    const char* checkpoint() noexcept override {
        const auto header = wav_header(format_, frames_, encoding_, speakers_);
        return put(header.data(), header.size(), 0);
    }
    const char* finish() noexcept override { return checkpoint(); }
    /// A frame's bytes are told in 16 bits; blocks of kBlock samples hold a frame.
    int most_channels() const noexcept override { return static_cast<int>(kBlock); }
    bool clips() const noexcept override { return encoding_ != Encoding::kFloat32; }
    std::uint64_t frames() const noexcept override { return frames_; }

private:
    std::uint64_t end() const noexcept {
        return (format_.channels > 2 || speakers_ != 0 ? kWideWavHeaderSize : kWavHeaderSize) +
               frames_ * static_cast<std::uint64_t>(sample_bytes(encoding_)) *
                   static_cast<std::uint64_t>(format_.channels);
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

    static constexpr std::size_t kBlock = 4096; ///< samples converted at a time

    Encoding encoding_;
    std::uint32_t speakers_;
    Quantiser quantiser_;
    int descriptor_ = -1;
    Format format_{1, 1};
    std::uint64_t frames_ = 0;
};

} // namespace

std::unique_ptr<FileWriter> make_wav_writer(Encoding encoding, std::uint32_t speakers) {
    return std::make_unique<WavWriter>(encoding, speakers);
}

} // namespace ode::sound
