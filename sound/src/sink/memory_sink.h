#pragma once

#include "sink/first_error.h"
#include "sink/sink.h"

#include <vector>

namespace ode::sound {

/// Keeps all samples. Memory for the first minute is set aside at open(), and doubles after: the
/// one sink whose write() may allocate, because its purpose is to grow.
class MemorySink final : public Sink {
public:
    bool open(const Format& format) override;
    std::size_t write(std::span<const float> interleaved) noexcept override;
    void close() noexcept override { closed_ = true; }
    const char* error() const noexcept override { return error_.text(); }
    const char* kind() const noexcept override { return "memory"; }

    /// Interleaved; valid until the next write().
    std::span<const float> samples() const noexcept { return sample_; }
    const Format& format() const noexcept { return format_; }

private:
    Format format_{0, 1};
    std::vector<float> sample_;
    bool closed_ = false;
    FirstError error_;
};

} // namespace ode::sound
