#include "sink/memory_sink.h"

#include <exception>

namespace ode::sound {

bool MemorySink::open(const Format& format) {
    if (closed_) {
        error_.set("memory sink: closed already; make another");
        return false;
    }
    if (format == format_)
        return true;
    if (format_.rate != 0) {
        error_.set("memory sink: already open with %d Hz and %d channels; make another for %d Hz "
                   "and %d channels",
                   format_.rate, format_.channels, format.rate, format.channels);
        return false;
    }
    format_ = format;
    sample_.reserve(std::size_t{60} * static_cast<std::size_t>(format.rate * format.channels));
    return true;
}

std::size_t MemorySink::write(std::span<const float> interleaved) noexcept {
    const std::size_t frames = interleaved.size() / static_cast<std::size_t>(format_.channels);
    if (closed_ || format_.rate == 0)
        return frames;
    try {
        sample_.insert(sample_.end(), interleaved.begin(), interleaved.end());
    } catch (const std::exception&) { // bad_alloc or length_error; what was kept stays
        error_.set("memory sink: out of memory after %.1f s of sound, which are kept; write longer "
                   "ones to a file",
                   static_cast<double>(sample_.size()) / format_.channels / format_.rate);
        closed_ = true; // a later success would leave a hole
    }
    return frames;
}

} // namespace ode::sound
