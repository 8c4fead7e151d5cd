#pragma once

#include <complex>
#include <span>
#include <vector>

namespace ode::sound {

/// One line of a spectrum.
struct Peak {
    double frequency; ///< [Hz]
    double amplitude; ///< of the sinusoid, in the unit of the signal
};

/// Amplitudes of the sinusoids in a signal: bin k at k * rate / n, n = samples.size() rounded up to
/// a power of two by zeros. Kaiser window (100 dB), scaled so that a lone sinusoid reads its
/// amplitude.
class Spectrum {
public:
    Spectrum(std::span<const double> samples, double rate);

    const std::vector<double>& amplitude() const noexcept { return amplitude_; }
    double bin_width() const noexcept { return bin_width_; } ///< [Hz]
    /// Half the width of a sinusoid's main lobe [Hz]: lines closer than twice this melt together.
    double lobe() const noexcept { return lobe_; }

    /// Highest line between two frequencies [Hz]; parabola through the logarithms of the three
    /// highest bins.
    Peak strongest(double low, double high) const;

    /// The highest `count` local maxima between two frequencies, apart by more than lobe(),
    /// strongest first.
    std::vector<Peak> peaks(double low, double high, int count) const;

private:
    Peak refine(std::size_t bin) const;

    std::vector<double> amplitude_;
    double bin_width_ = 0.0;
    double lobe_ = 0.0;
};

/// Root mean square of what lies between two frequencies [Hz], under a Kaiser window that is taken
/// out of the result: of a stationary signal, the unit of the signal.
double band_rms(std::span<const double> samples, double rate, double low, double high);

/// Complex amplitude A of one frequency [Hz]: the signal is Re(A e^{i w t}) with t = 0 at the first
/// sample. Least squares together with a constant, under a Hann window.
std::complex<double> phasor(std::span<const double> samples, double rate, double frequency);

} // namespace ode::sound
