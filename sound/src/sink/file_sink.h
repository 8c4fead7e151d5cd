#pragma once

#include "sink/file_writer.h"
#include "sink/first_error.h"
#include "sink/side_note.h"
#include "sink/sink.h"

#include <memory>
#include <optional>
#include <string>

namespace ode::sound {

/// Streams to a file; its ending names the format (see formats()). The same samples give the same
/// bytes. A program that dies loses at most the last kCheckpoint of sound; a full disk ends the
/// file at the last whole frame, with a message.
///
/// write() goes through the page cache at once: no lag, no loss, but on a slow disk it may take as
/// long as the kernel needs to find a free page.
class FileSink final : public Sink {
public:
    static constexpr double kCheckpoint = 0.25; ///< [s]

    /// Opens the path, so that one that cannot be written is told of now and not after an hour. An
    /// existing file keeps its content until open().
    /// @throws Refused
    /// @param bits  32 (float), 24 or 16; 0: the format's own, 32 for .wav and 24 for .flac.
    /// @param note  write JSON beside it, named like it with ".json" for its ending.
    /// @param speakers  see wav_header(); .wav only.
    explicit FileSink(const std::string& path, int bits = 0, bool note = false,
                      std::uint32_t speakers = 0);
    FileSink(const FileSink&) = delete;
    FileSink& operator=(const FileSink&) = delete;
    ~FileSink() override { close(); }

    bool open(const Format& format) override;
    std::size_t write(std::span<const float> interleaved) noexcept override;
    void close() noexcept override;
    const char* error() const noexcept override { return error_.text(); }
    const char* kind() const noexcept override { return "file"; }

    void calibrate(const Calibration& calibration) override;
    /// Notes an event at the next frame. @return false without a note.
    bool mark(const char* text);

    /// The endings and what they stand for, as a phrase for messages.
    static const char* formats() noexcept { return ".wav or .flac"; }

private:
    void fail(const char* reason) noexcept;
    void watch_clipping(std::span<const float> interleaved) noexcept;

    void write_note() noexcept;

    std::string path_;
    std::uint32_t speakers_;
    Encoding encoding_ = Encoding::kFloat32;
    std::optional<SideNote> note_;
    std::unique_ptr<FileWriter> writer_;
    int descriptor_ = -1;
    bool created_ = false; ///< the path did not exist before
    Format format_{0, 1};
    std::uint64_t checkpoint_frames_ = 0; ///< in the file when it was last made readable
    FirstError error_;
};

} // namespace ode::sound
