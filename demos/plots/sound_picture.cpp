#include "plots/sound_picture.h"

#include "plots/gnuplot.h"
#include "plots/spectrogram.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace plots {
namespace {

constexpr int kColumns = 640;
constexpr double kRange = 80; // [dB] shown below the loudest cell
constexpr double kStep = 4;   // [dB] between colours: few colours make small files

/// Least and greatest sample in each of `columns` stretches, as x low high triples.
std::vector<float> envelope(std::span<const float> signal, double rate, int columns) {
    std::vector<float> out;
    const std::size_t n = signal.size();
    const auto count = static_cast<std::size_t>(columns);
    for (std::size_t c = 0; c < count && c < n; ++c) {
        const std::size_t first = n * c / count;
        const std::size_t last = std::max(first + 1, n * (c + 1) / count);
        const auto [low, high] = std::minmax_element(signal.begin() + static_cast<long>(first),
                                                     signal.begin() + static_cast<long>(last));
        out.push_back(static_cast<float>(static_cast<double>(first) / rate));
        out.push_back(*low);
        out.push_back(*high);
    }
    return out;
}

/// Largest of 1, 2, 5 times a power of ten that is not above x.
double round_down(double x) {
    const double power = std::pow(10, std::floor(std::log10(x)));
    return x >= 5 * power ? 5 * power : x >= 2 * power ? 2 * power : power;
}

void say_waveform(Gnuplot& gnuplot, const SoundPicture& p) {
    const std::vector<float> wave = envelope(p.signal, p.rate, kColumns);
    double peak = 1e-12;
    for (const float x : p.signal)
        peak = std::max(peak, static_cast<double>(std::abs(x)));
    std::ostringstream say;
    say << "set yrange [" << -1.1 * peak << ":" << 1.1 * peak << "]; set ytics " << round_down(peak)
        << "\n"
        << "set tmargin at screen 0.93; set bmargin at screen 0.72\n"
        << "set title " << quoted(p.title) << " noenhanced offset 0,-0.5\n"
        << "set ylabel 'Pa'; set format x ''\n"
        << "plot '-' binary record=(" << wave.size() / 3
        << ") format='%float%float%float' using 1:2:3 with filledcurves lc rgb '#303060' notitle\n";
    gnuplot.say(say.str());
    gnuplot.send(wave);
    gnuplot.say("unset title; set format x '%g'; set ytics autofreq\n");
}

void say_spectrogram(Gnuplot& gnuplot, const SoundPicture& p) {
    // 1024 samples at 48 kHz: 21 ms and 94 Hz, fine enough for impacts and for partials both.
    Spectrogram s = spectrogram(p.signal, p.rate, 1024, kColumns);
    const int rows = std::min(s.rows, static_cast<int>(p.top / s.row_height) + 1);
    s.level.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(s.columns));
    const float loudest = *std::max_element(s.level.begin(), s.level.end());
    for (float& level : s.level)
        level = static_cast<float>(
            std::max(-kRange, kStep * std::round((static_cast<double>(level - loudest)) / kStep)));
    std::ostringstream say;
    say << "set tmargin at screen 0.68; set bmargin at screen 0.10\n"
        << "set xlabel 'time / s'; set ylabel 'frequency / kHz'\n"
        << "set yrange [0:" << p.top / 1000 << "]\n"
        << "set cbrange [" << -kRange << ":0]; set cblabel 'dB, loudest 0' offset 1,0\n"
        << "set colorbox user origin screen 0.91,0.10 size screen 0.02,0.58\n"
        << "set palette defined (0 'white', 0.35 '#8fb8de', 0.7 '#3a3a98', 1 '#d0202e')\n";
    for (const double line : p.lines)
        if (line < p.top)
            say << "set arrow from graph 1, first " << line / 1000
                << " rto graph 0.02, 0 nohead lc rgb '#d0202e' lw 1.5\n";
    say << "set label 'modes' at graph 1.002, graph 1.025 font ',9' tc rgb '#d0202e'\n"
        << "plot '-' binary array=(" << s.columns << ',' << rows
        << ") format='%float' dx=" << s.column_width << " dy=" << s.row_height / 1000 << " origin=("
        << s.column_width / 2 << ",0) with image notitle\n";
    gnuplot.say(say.str());
    gnuplot.send(s.level);
}

} // namespace

std::string draw(const SoundPicture& picture, const std::string& path) {
    if (picture.signal.empty())
        return "there is no sound to draw";
    Gnuplot gnuplot;
    std::ostringstream say;
    say << "set terminal png size 900,600 font 'sans,11'\n"
        << "set output " << quoted(path) << "\n"
        << "set multiplot\n"
        << "set lmargin at screen 0.09; set rmargin at screen 0.87\n"
        << "set xrange [0:" << static_cast<double>(picture.signal.size()) / picture.rate << "]\n"
        << "set tics out nomirror\n";
    gnuplot.say(say.str());
    say_waveform(gnuplot, picture);
    say_spectrogram(gnuplot, picture);
    gnuplot.say("\nunset multiplot\n");
    return gnuplot.finish();
}

} // namespace plots
