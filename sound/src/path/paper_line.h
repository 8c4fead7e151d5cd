#pragma once

#include "path/line.h"

#include <vector>

namespace ode::sound {

/// P01's accumulation buffer as written (3.3): audio rate, a Gaussian two samples wide, read at the
/// current time.
///
/// Two samples are taken as plus and minus two standard deviations: sigma = 1/2 sample, four taps.
/// The taps are not made to sum to one, since the paper doesn't: the sum wavers by 0.8 % with the
/// fraction of a sample, and the Gaussian is 5 dB down at 15 kHz.
class PaperLine final : public Line {
public:
    static constexpr double kSigma = 0.5; ///< [samples]
    static constexpr int kBefore = 1;     ///< taps before the sample that an arrival rounds down to
    static constexpr int kAfter = 2;

    /// @param rate           audio rate [Hz].
    /// @param frame          first audio frame to come.
    /// @param gain           of what is read.
    /// @param differentiate  by time, as the difference of neighbouring samples.
    PaperLine(double rate, std::int64_t frame, double gain, bool differentiate);

    /// @param sample  sent at this frame, @param delay later [samples] heard.
    void add(std::int64_t sample, double delay, double value) noexcept;

    void read(int frames, double* out) noexcept override;
    std::int64_t last_frame() const noexcept override { return latest_; }

private:
    std::vector<double> ring_;
    std::int64_t mask_;
    std::int64_t next_;
    std::int64_t latest_;
    double gain_;
    bool differentiate_;
    double before_ = 0.0;
};

} // namespace ode::sound
