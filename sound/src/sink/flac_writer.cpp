#include "sink/file_writer.h"
#include "sink/quantiser.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sndfile.h>
#include <unistd.h>

namespace ode::sound {
namespace {

/// FLAC frames stand alone, so that a file cut short plays up to its last whole one (4096 samples
/// a channel at most); only the length is missing from its header.
class FlacWriter final : public FileWriter {
public:
    explicit FlacWriter(Encoding encoding) : encoding_(encoding), quantiser_(encoding) {}
    FlacWriter(const FlacWriter&) = delete;
    FlacWriter& operator=(const FlacWriter&) = delete;
    ~FlacWriter() override { finish(); }

    const char* begin(int descriptor, const Format& format) noexcept override {
        descriptor_ = descriptor;
        channels_ = format.channels;
        SF_INFO info{};
        info.samplerate = format.rate;
        info.channels = format.channels;
        info.format =
            SF_FORMAT_FLAC | (encoding_ == Encoding::kInt16 ? SF_FORMAT_PCM_16 : SF_FORMAT_PCM_24);
        // Own callbacks, because libsndfile loses the reason of a failed write in the encoder.
        SF_VIRTUAL_IO io{length, seek, read, write, tell};
        file_ = sf_open_virtual(&io, SFM_WRITE, &info, this);
        if (!file_)
            return failure();
        sf_command(file_, SFC_SET_CLIPPING, nullptr, SF_TRUE);
        return nullptr;
    }

    const char* append(std::span<const float> interleaved) noexcept override {
        const auto frames = static_cast<sf_count_t>(interleaved.size()) / channels_;
        if (encoding_ == Encoding::kInt16)
            return append_dithered(interleaved);
        const sf_count_t done = sf_writef_float(file_, interleaved.data(), frames);
        if (done != frames || errno_ != 0)
            return failure();
        frames_ += static_cast<std::uint64_t>(done);
        return nullptr;
    }

    const char* checkpoint() noexcept override { return nullptr; }

    const char* finish() noexcept override {
        if (!file_)
            return nullptr;
        sf_close(file_);
        file_ = nullptr;
        return errno_ != 0 ? std::strerror(errno_) : nullptr;
    }
    int most_channels() const noexcept override { return 8; }
    bool clips() const noexcept override { return true; }
    std::uint64_t frames() const noexcept override { return frames_; }

private:
    const char* append_dithered(std::span<const float> interleaved) noexcept {
        constexpr std::size_t kBlock = 4096; // samples
        short value[kBlock];
        const auto channels = static_cast<std::size_t>(channels_);
        while (interleaved.size() >= channels) {
            const std::size_t part =
                std::min(interleaved.size() / channels, kBlock / channels) * channels;
            for (std::size_t i = 0; i < part; ++i)
                value[i] = static_cast<short>(quantiser_(interleaved[i]));
            const auto frames = static_cast<sf_count_t>(part / channels);
            if (sf_writef_short(file_, value, frames) != frames || errno_ != 0)
                return failure();
            frames_ += part / channels;
            interleaved = interleaved.subspan(part);
        }
        return nullptr;
    }

    static FlacWriter& self(void* data) noexcept { return *static_cast<FlacWriter*>(data); }
    static sf_count_t length(void* data) {
        const int fd = self(data).descriptor_;
        const off_t here = lseek(fd, 0, SEEK_CUR);
        const off_t end = lseek(fd, 0, SEEK_END);
        lseek(fd, here, SEEK_SET);
        return end;
    }
    static sf_count_t seek(sf_count_t offset, int whence, void* data) {
        return lseek(self(data).descriptor_, offset, whence);
    }
    static sf_count_t read(void* to, sf_count_t size, void* data) {
        return ::read(self(data).descriptor_, to, static_cast<std::size_t>(size));
    }
    static sf_count_t write(const void* from, sf_count_t size, void* data) {
        const auto* bytes = static_cast<const unsigned char*>(from);
        sf_count_t done = 0;
        while (done < size) {
            const ssize_t part = ::write(self(data).descriptor_, bytes + done,
                                         static_cast<std::size_t>(size - done));
            if (part < 0 && errno == EINTR)
                continue;
            if (part < 0) {
                self(data).errno_ = errno;
                break;
            }
            done += part;
        }
        return done;
    }
    static sf_count_t tell(void* data) { return lseek(self(data).descriptor_, 0, SEEK_CUR); }

    const char* failure() const noexcept {
        return errno_ != 0 ? std::strerror(errno_) : sf_strerror(file_);
    }

    Encoding encoding_;
    Quantiser quantiser_;
    int descriptor_ = -1;
    int channels_ = 1;
    int errno_ = 0; ///< of the first failed write
    SNDFILE* file_ = nullptr;
    std::uint64_t frames_ = 0;
};

} // namespace

std::unique_ptr<FileWriter> make_flac_writer(Encoding encoding) {
    return std::make_unique<FlacWriter>(encoding);
}

} // namespace ode::sound
