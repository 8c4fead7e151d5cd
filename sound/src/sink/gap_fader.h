#pragma once

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
    static constexpr std::size_t kOrder = 32;     ///< of the prediction: up to 16 partials

    explicit GapFader(int channels);

    /// @param block  interleaved; its first `ready` frames are the stream's, the rest is made here.
    void fill(std::span<float> block, std::size_t ready) noexcept;

    /// The device stopped hard: what it played last cannot be continued. Fades in from silence.
    void restart() noexcept;

private:
    struct Channel {
        std::vector<float> history;    ///< last kHistory frames given out, oldest first
        std::vector<double> predictor; ///< x[n] = sum of predictor[k] x[n-1-k]
        std::vector<double> recent;    ///< last kOrder predicted frames, unfaded, newest first
        double bound = 0;              ///< the prediction may not exceed what was heard
        double predict() noexcept;
    };

    void begin_gap() noexcept;
    void render(std::span<float> block, bool missing) noexcept;
    void remember(std::span<const float> block) noexcept;

    std::size_t channels_;
    std::vector<Channel> channel_;
    std::vector<double> rise_;                          ///< raised cosine, 0 to 1
    std::vector<double> forward_, backward_, previous_; ///< work space of the fit
    bool in_gap_ = false;
    std::size_t faded_in_ = kFade;  ///< frames of the stream since a gap, up to kFade
    std::size_t faded_out_ = kFade; ///< frames of the prediction played, up to kFade
};

/// Linear prediction by Burg's recursion: its predictor is stable, and sharp on few periods.
/// J. P. Burg, "Maximum entropy spectral analysis" (1975), in the form of
/// doi:10.1109/PROC.1982.12427, section V. Stops where the residue is rounding error.
/// @param forward, backward  work space of signal.size(); @param previous of predictor.size().
void fit_burg(std::span<const float> signal, std::span<double> predictor, std::span<double> forward,
              std::span<double> backward, std::span<double> previous) noexcept;

} // namespace ode::sound
