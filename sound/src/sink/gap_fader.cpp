#include "sink/gap_fader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {

GapFader::GapFader(int channels)
    : channels_(static_cast<std::size_t>(channels)), channel_(channels_), rise_(kFade) {
    for (Channel& c : channel_)
        c.history.resize(kHistory);
    for (std::size_t i = 0; i < kFade; ++i)
        rise_[i] = 0.5 - 0.5 * std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / kFade);
}

void GapFader::fill(std::span<float> block, std::size_t ready) noexcept {
    const auto stream = block.first(ready * channels_);
    const auto missing = block.subspan(ready * channels_);
    if (!stream.empty()) {
        in_gap_ = false;
        remember_stream(stream);
        render(stream, false);
        remember_given(stream);
    }
    if (!missing.empty()) {
        if (!in_gap_)
            begin_gap();
        render(missing, true);
        remember_given(missing);
    }
}

void GapFader::restart() noexcept {
    for (Channel& c : channel_)
        c.given = {};
    in_gap_ = true;
    faded_in_ = 0;
    faded_out_ = kFade;
}

void GapFader::begin_gap() noexcept {
    // What was given out last may be stream and an earlier bridge mixed: then it is not what the
    // fit should learn from, but where the new bridge must begin.
    for (Channel& c : channel_) {
        c.predictor = fit_predictor(c.history);
        c.recent = c.given;
        c.bound = 0;
        for (const float x : c.history)
            c.bound = std::max(c.bound, std::fabs(static_cast<double>(x)));
    }
    in_gap_ = true;
    faded_in_ = 0;
    faded_out_ = 0;
}

double GapFader::Channel::predict() noexcept {
    double next = 0;
    for (std::size_t k = 0; k < kPredictionOrder; ++k)
        next += predictor[k] * recent[k];
    next = std::clamp(next, -bound, bound);
    std::copy_backward(recent.begin(), recent.end() - 1, recent.end());
    recent.front() = next;
    return next;
}

void GapFader::render(std::span<float> block, bool missing) noexcept {
    const std::size_t frames = block.size() / channels_;
    for (std::size_t i = 0; i < frames; ++i) {
        const bool bridging = faded_out_ < kFade;
        if (!missing && !bridging && faded_in_ == kFade)
            return; // bit for bit from here on
        const double stream_gain = missing ? 0 : faded_in_ < kFade ? rise_[faded_in_] : 1;
        for (std::size_t c = 0; c < channels_; ++c) {
            float& sample = block[i * channels_ + c];
            const double stream = missing ? 0 : stream_gain * static_cast<double>(sample);
            const double bridge = bridging ? (1 - rise_[faded_out_]) * channel_[c].predict() : 0;
            sample = static_cast<float>(stream + bridge);
        }
        if (bridging)
            ++faded_out_;
        if (!missing && faded_in_ < kFade)
            ++faded_in_;
    }
}

void GapFader::remember_stream(std::span<const float> stream) noexcept {
    const std::size_t frames = stream.size() / channels_;
    const std::size_t fresh = std::min(frames, kHistory);
    for (std::size_t c = 0; c < channels_; ++c) {
        auto& history = channel_[c].history;
        std::copy(history.begin() + static_cast<std::ptrdiff_t>(fresh), history.end(),
                  history.begin());
        for (std::size_t i = 0; i < fresh; ++i)
            history[kHistory - fresh + i] = stream[(frames - fresh + i) * channels_ + c];
    }
}

void GapFader::remember_given(std::span<const float> block) noexcept {
    const std::size_t frames = block.size() / channels_;
    const std::size_t fresh = std::min(frames, kPredictionOrder);
    for (std::size_t c = 0; c < channels_; ++c) {
        auto& given = channel_[c].given;
        std::copy_backward(given.begin(), given.end() - static_cast<std::ptrdiff_t>(fresh),
                           given.end());
        for (std::size_t i = 0; i < fresh; ++i)
            given[i] = block[(frames - 1 - i) * channels_ + c];
    }
}

} // namespace ode::sound
