#pragma once

#include <span>
#include <vector>

namespace plots {

/// Level over time and frequency.
struct Spectrogram {
    int columns = 0;          ///< moments
    int rows = 0;             ///< frequencies, from 0 up
    double column_width = 0;  ///< [s]
    double row_height = 0;    ///< [Hz]
    std::vector<float> level; ///< columns x rows, row by row [dB], 0 dB: a sine of amplitude 1
};

/// Short-time Fourier transform with a Hann window (sidelobes fall 18 dB an octave; main lobe four
/// bins wide), hopping so that about `columns` spectra cover the signal.
/// @param window  samples a spectrum, a power of two; frequency resolution is 2 rate / window
Spectrogram spectrogram(std::span<const float> signal, double rate, int window, int columns);

/// Power spectrum of the whole signal, Hann-windowed and zero-padded to a power of two [dB], as
/// one column.
Spectrogram spectrum(std::span<const float> signal, double rate);

} // namespace plots
