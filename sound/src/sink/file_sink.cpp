#include "sink/file_sink.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace ode::sound {
namespace {

std::unique_ptr<FileWriter> writer_for(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".wav")
        return make_wav_writer();
    if (ending == ".flac")
        return make_flac_writer();
    throw Refused("'" + path + "': the ending '" + ending +
                  "' names no sound format; end the path in " + FileSink::formats());
}

const char* cure(int error) noexcept {
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return "make the folder first or correct the path";
    case EACCES:
    case EPERM:
    case EROFS:
        return "choose a folder you may write to";
    case EISDIR:
        return "add a file name";
    case ENOSPC:
    case EDQUOT:
        return "free space or name a file on another disk";
    default:
        return "choose another path";
    }
}

[[noreturn]] void refuse(const std::string& path, int error) {
    throw Refused(path + ": cannot be written (" + std::strerror(error) + "); " + cure(error));
}

} // namespace

FileSink::FileSink(const std::string& path) : path_(path), writer_(writer_for(path)) {
    // O_NONBLOCK: a pipe without a reader would hold the program here.
    constexpr int kFlags = O_RDWR | O_CLOEXEC | O_NONBLOCK;
    descriptor_ = ::open(path.c_str(), kFlags | O_CREAT | O_EXCL, 0666);
    created_ = descriptor_ >= 0;
    if (!created_)
        descriptor_ = ::open(path.c_str(), kFlags | O_CREAT, 0666);
    if (descriptor_ < 0)
        refuse(path, errno);
    if (lseek(descriptor_, 0, SEEK_SET) < 0) {
        ::close(descriptor_);
        throw Refused(path + ": is a pipe or terminal, but a sound file's header is written last; "
                             "choose a file");
    }
}

bool FileSink::open(const Format& format) {
    if (descriptor_ < 0) {
        error_.set("%s: closed already; make another sink", path_.c_str());
        return false;
    }
    if (format == format_)
        return true;
    if (format_.rate != 0) {
        error_.set(
            "%s: already written with %d Hz and %d channels; make another sink for %d Hz and "
            "%d channels",
            path_.c_str(), format_.rate, format_.channels, format.rate, format.channels);
        return false;
    }
    format_ = format;
    struct stat status {};
    const bool regular = fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
    const char* reason = nullptr;
    if (regular && ftruncate(descriptor_, 0) != 0)
        reason = std::strerror(errno);
    if (!reason)
        reason = writer_->begin(descriptor_, format);
    if (reason)
        fail(reason);
    return !reason;
}

std::size_t FileSink::write(std::span<const float> interleaved) noexcept {
    const std::size_t frames = interleaved.size() / static_cast<std::size_t>(format_.channels);
    if (descriptor_ < 0 || format_.rate == 0)
        return frames;
    if (writer_->clips())
        watch_clipping(interleaved);
    const char* reason = writer_->append(interleaved);
    if (!reason &&
        static_cast<double>(writer_->frames() - checkpoint_frames_) >= kCheckpoint * format_.rate) {
        reason = writer_->checkpoint();
        checkpoint_frames_ = writer_->frames();
    }
    if (reason)
        fail(reason);
    return frames;
}

void FileSink::close() noexcept {
    if (descriptor_ < 0)
        return;
    if (format_.rate == 0) {
        if (created_)
            unlink(path_.c_str()); // never used: leave no empty file behind
        ::close(descriptor_);
        descriptor_ = -1;
    } else if (const char* reason = writer_->finish()) {
        fail(reason);
    } else {
        if (::close(descriptor_) != 0) // some network file systems tell of a full disk only here
            error_.set("%s: %s on closing; its end may be missing", path_.c_str(),
                       std::strerror(errno));
        descriptor_ = -1;
    }
}

void FileSink::fail(const char* reason) noexcept {
    if (writer_->frames() == 0)
        error_.set("%s: cannot be written (%s); free space or choose another path", path_.c_str(),
                   reason);
    else
        error_.set(
            "%s: %s after %.2f s of sound, which stay in the file; free space or name a file "
            "on another disk",
            path_.c_str(), reason, static_cast<double>(writer_->frames()) / format_.rate);
    writer_->finish();
    ::close(descriptor_);
    descriptor_ = -1;
}

void FileSink::watch_clipping(std::span<const float> interleaved) noexcept {
    if (error_.is_set())
        return;
    const auto beyond = std::find_if(interleaved.begin(), interleaved.end(),
                                     [](float sample) { return std::fabs(sample) > 1.0F; });
    if (beyond == interleaved.end())
        return;
    const auto frames = static_cast<double>(writer_->frames()) +
                        static_cast<double>((beyond - interleaved.begin()) / format_.channels);
    error_.set("%s: clipped at full scale, first at %.3f s; raise the full scale "
               "(dSoundSetFullScale) or write .wav, which keeps louder samples",
               path_.c_str(), frames / format_.rate);
}

} // namespace ode::sound
