#include "sink/gap_fader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {

void fit_burg(std::span<const float> signal, std::span<double> predictor, std::span<double> forward,
              std::span<double> backward, std::span<double> previous) noexcept {
    const std::size_t n = signal.size();
    std::fill(predictor.begin(), predictor.end(), 0.0);
    std::copy(signal.begin(), signal.end(), forward.begin());
    std::copy(signal.begin(), signal.end(), backward.begin());
    double first_power = 0;
    for (std::size_t order = 0; order < predictor.size(); ++order) {
        // Errors of the forward prediction at i and of the backward one at i - 1.
        double cross = 0;
        double power = 0;
        for (std::size_t i = order + 1; i < n; ++i) {
            cross += forward[i] * backward[i - 1];
            power += forward[i] * forward[i] + backward[i - 1] * backward[i - 1];
        }
        if (order == 0)
            first_power = power;
        // Samples are floats: below the square of their rounding, 2^-48, there is only noise to
        // fit.
        if (!(power > 3.6e-15 * first_power))
            return;
        const double reflection = 2 * cross / power;
        std::copy_n(predictor.begin(), order, previous.begin());
        for (std::size_t k = 0; k < order; ++k)
            predictor[k] = previous[k] - reflection * previous[order - 1 - k];
        predictor[order] = reflection;
        for (std::size_t i = n - 1; i > order; --i) {
            const double f = forward[i];
            forward[i] = f - reflection * backward[i - 1];
            backward[i] = backward[i - 1] - reflection * f;
        }
    }
}

GapFader::GapFader(int channels)
    : channels_(static_cast<std::size_t>(channels)), channel_(channels_), rise_(kFade),
      forward_(kHistory), backward_(kHistory), previous_(kOrder) {
    for (Channel& c : channel_) {
        c.history.resize(kHistory);
        c.predictor.resize(kOrder);
        c.recent.resize(kOrder);
    }
    for (std::size_t i = 0; i < kFade; ++i)
        rise_[i] = 0.5 - 0.5 * std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / kFade);
}

void GapFader::fill(std::span<float> block, std::size_t ready) noexcept {
    const auto stream = block.first(ready * channels_);
    const auto missing = block.subspan(ready * channels_);
    if (!stream.empty()) {
        in_gap_ = false;
        render(stream, false);
        remember(stream);
    }
    if (!missing.empty()) {
        if (!in_gap_)
            begin_gap();
        render(missing, true);
        remember(missing);
    }
}

void GapFader::restart() noexcept {
    for (Channel& c : channel_)
        std::fill(c.history.begin(), c.history.end(), 0.0F);
    in_gap_ = true;
    faded_in_ = 0;
    faded_out_ = kFade;
}

void GapFader::begin_gap() noexcept {
    // What was given out may itself be stream and prediction mixed; fitting that mixture keeps the
    // output smooth however short the stretches of stream are.
    for (Channel& c : channel_) {
        fit_burg(c.history, c.predictor, forward_, backward_, previous_);
        std::copy_n(c.history.rbegin(), kOrder, c.recent.begin());
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
    for (std::size_t k = 0; k < kOrder; ++k)
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

void GapFader::remember(std::span<const float> block) noexcept {
    const std::size_t frames = block.size() / channels_;
    const std::size_t fresh = std::min(frames, kHistory);
    for (std::size_t c = 0; c < channels_; ++c) {
        auto& history = channel_[c].history;
        std::copy(history.begin() + static_cast<std::ptrdiff_t>(fresh), history.end(),
                  history.begin());
        for (std::size_t i = 0; i < fresh; ++i)
            history[kHistory - fresh + i] = block[(frames - fresh + i) * channels_ + c];
    }
}

} // namespace ode::sound
