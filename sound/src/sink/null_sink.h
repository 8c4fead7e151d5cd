#pragma once

#include "sink/sink.h"

namespace ode::sound {

/// Takes samples and forgets them: for runs without a sound card and for measuring all but output.
class NullSink final : public Sink {
public:
    bool open(const Format& format) override {
        channels_ = format.channels;
        return true;
    }
    std::size_t write(std::span<const float> interleaved) noexcept override {
        return interleaved.size() / static_cast<std::size_t>(channels_);
    }
    void close() noexcept override {}
    const char* error() const noexcept override { return ""; }
    const char* kind() const noexcept override { return "null"; }

private:
    int channels_ = 1;
};

} // namespace ode::sound
