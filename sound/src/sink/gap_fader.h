#pragma once

#include "sink/prediction.h"

#include <cstddef>
#include <span>
#include <vector>

namespace ode::sound {

/// Bridges gaps in a stream without a click. When frames are missing, the last 21 ms (at 48 kHz)
/// are continued by linear prediction, which carries on ringing modes, and faded out; a constant is
/// held and faded. When frames come again they are faded in from where the stream stopped. Outside
/// of gaps and fades samples pass bit for bit. Nothing is held back, so there is no delay.
///
/// One thread; no allocation after construction.
class GapFader {
public:
    /// Length of a fade [frames]. The raised cosine changes by at most pi/(2 kFade) = 7.7e-4 a
    /// frame: a full-scale constant makes no step above -62 dBFS, at any rate.
    static constexpr std::size_t kFade = 2048;
    static constexpr std::size_t kHistory = 1024; ///< [frames] that the prediction is fitted to

    explicit GapFader(int channels);

    /// @param block  interleaved; its first `ready` frames are the stream's, the rest is made here.
    void fill(std::span<float> block, std::size_t ready) noexcept;

    /// The device stopped hard: what it played last cannot be continued. Fades in from silence.
    void restart() noexcept;

private:
    struct Channel {
        std::vector<float> history; ///< last kHistory frames of the stream, oldest first
        Predictor predictor{};
        Predictor given{};  ///< last frames given out, newest first
        Predictor recent{}; ///< last frames of the bridge before its fade, newest first
        double bound = 0;   ///< the bridge may not exceed the stream
        double predict() noexcept;
    };

    void begin_gap() noexcept;
    void render(std::span<float> block, bool missing) noexcept;
    void remember_stream(std::span<const float> stream) noexcept;
    void remember_given(std::span<const float> block) noexcept;

    std::size_t channels_;
    std::vector<Channel> channel_;
    std::vector<double> rise_; ///< raised cosine, 0 to 1
    bool in_gap_ = false;
    std::size_t faded_in_ = kFade;  ///< frames of the stream since a gap, up to kFade
    std::size_t faded_out_ = kFade; ///< frames of the prediction played, up to kFade
};

} // namespace ode::sound
