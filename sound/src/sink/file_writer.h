#pragma once

#include "sink/sink.h"

#include <cstdint>
#include <memory>

namespace ode::sound {

/// One file format over an open, seekable descriptor that it doesn't own. Each function returns
/// nullptr, or the reason of its failure in the words of the system.
class FileWriter {
public:
    virtual ~FileWriter() = default;
    virtual const char* begin(int descriptor, const Format& format) noexcept = 0;
    virtual const char* append(std::span<const float> interleaved) noexcept = 0;
    /// Makes all that was appended readable, should the program end here.
    virtual const char* checkpoint() noexcept = 0;
    virtual const char* finish() noexcept = 0;
    /// Channels that the format can hold.
    virtual int most_channels() const noexcept = 0;
    /// Whether samples beyond +-1 are clipped.
    virtual bool clips() const noexcept = 0;
    /// Whole frames that are in the file.
    virtual std::uint64_t frames() const noexcept = 0;
};

/// How samples lie in a file. Integers are rounded; 16 bits with triangular dither of one step, so
/// that what is quieter than a step stays and is not distorted; the noise is the same every time.
enum class Encoding { kFloat32, kInt24, kInt16 };
const char* encoding_name(Encoding encoding) noexcept;

/// RIFF/WAVE; RF64 (EBU Tech 3306) from 4 GiB on.
/// @param speakers  see wav_header()
std::unique_ptr<FileWriter> make_wav_writer(Encoding encoding, std::uint32_t speakers = 0);
/// FLAC of 24 or 16 bits, by libsndfile.
std::unique_ptr<FileWriter> make_flac_writer(Encoding encoding);

} // namespace ode::sound
