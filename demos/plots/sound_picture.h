#pragma once

#include <span>
#include <string>

namespace plots {

/// What a picture of a sound shows.
struct SoundPicture {
    std::string title;
    std::span<const float> signal; ///< one channel [Pa]
    double rate = 0;               ///< [Hz]
    std::span<const double> lines; ///< predicted frequencies, marked at the right edge [Hz]
    double top = 0;                ///< highest frequency shown [Hz]
};

/// Draws waveform over spectrogram into a PNG below 100 kB, by gnuplot.
/// @return "" or a sentence saying why there is no picture.
std::string draw(const SoundPicture& picture, const std::string& path);

} // namespace plots
