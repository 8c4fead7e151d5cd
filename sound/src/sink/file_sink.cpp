#include "sink/file_sink.h"

#include <algorithm>
#include <bit>
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

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

Encoding encoding_for(const std::string& path, int bits) {
    const std::string ending = ending_of(path);
    if (ending != ".wav" && ending != ".flac")
        throw Refused("'" + path + "': the ending '" + ending +
                      "' names no sound format; end the path in " + FileSink::formats());
    const bool flac = ending == ".flac";
    if (bits == 0)
        return flac ? Encoding::kInt24 : Encoding::kFloat32;
    if (bits == 24 || bits == 16)
        return bits == 24 ? Encoding::kInt24 : Encoding::kInt16;
    if (bits == 32 && !flac)
        return Encoding::kFloat32;
    throw Refused("'" + path + "': " + std::to_string(bits) + " bits can't be had; choose " +
                  (flac ? "24 or 16" : "32 (float), 24 or 16"));
}

std::unique_ptr<FileWriter> writer_for(const std::string& path, Encoding encoding,
                                       std::uint32_t speakers) {
    if (ending_of(path) == ".wav")
        return make_wav_writer(encoding, speakers);
    if (speakers != 0)
        throw Refused("'" + path +
                      "': .flac has an order of loudspeakers of its own for each "
                      "number of channels; leave speakers 0 or end the path in .wav");
    return make_flac_writer(encoding);
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

const char* encoding_name(Encoding encoding) noexcept {
    constexpr const char* kNames[] = {"float 32", "integer 24", "integer 16"};
    return kNames[static_cast<int>(encoding)];
}

FileSink::FileSink(const std::string& path, int bits, bool note, std::uint32_t speakers)
    : path_(path), speakers_(speakers), encoding_(encoding_for(path, bits)),
      writer_(writer_for(path, encoding_, speakers)) {
    if (note)
        note_.emplace(std::filesystem::path(path).replace_extension(".json").string());
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
    if (format.channels < 1 || format.channels > writer_->most_channels()) {
        error_.set(
            "%s: holds 1 to %d channels, not %d; write several files, or a .wav, which holds "
            "4096",
            path_.c_str(), writer_->most_channels(), format.channels);
        return false;
    }
    if (speakers_ != 0 && std::popcount(speakers_) != format.channels) {
        error_.set("%s: speakers 0x%x names %d loudspeakers for %d channels; set as many bits as "
                   "channels, or 0",
                   path_.c_str(), speakers_, std::popcount(speakers_), format.channels);
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

void FileSink::calibrate(const Calibration& calibration) {
    if (!note_)
        return;
    note_->set(calibration);
    write_note(); // for the case that the program dies
}

bool FileSink::mark(const char* text) {
    if (!note_)
        return false;
    note_->add_event(writer_->frames(), text);
    return true;
}

void FileSink::write_note() noexcept {
    const char* reason = nullptr;
    try {
        reason = note_->write(path_, encoding_name(encoding_), format_, writer_->frames());
    } catch (const std::exception&) {
        reason = "out of memory";
    }
    if (reason)
        error_.set("%s: cannot be written (%s); the sound itself is whole", note_->path().c_str(),
                   reason);
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
    if (note_ && format_.rate != 0)
        write_note();
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
    if (note_)
        write_note();
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
    error_.set(
        "%s: clipped at full scale, first at %.3f s; raise the full scale "
        "(dSoundSetFullScale), set a limiter or write .wav of 32 bits, which keeps louder samples",
        path_.c_str(), frames / format_.rate);
}

} // namespace ode::sound
