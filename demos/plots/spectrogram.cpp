#include "plots/spectrogram.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace plots {
namespace {

/// Levels of `signal` from sample `first` on, where samples outside it are silence.
class Column {
public:
    /// @param length  samples the window spans, @param padded  samples transformed
    Column(int length, int padded)
        : window_(static_cast<std::size_t>(length)), piece_(static_cast<std::size_t>(padded)) {
        for (std::size_t i = 0; i < window_.size(); ++i) {
            const double u = (static_cast<double>(i) + 0.5) / length;
            window_[i] = static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * u));
            gain_ += window_[i];
        }
        fft_.SetFlag(fft_.HalfSpectrum);
    }

    /// @param level  out: padded / 2 + 1 levels, `stride` apart [dB]
    void operator()(std::span<const float> signal, std::ptrdiff_t first, float* level,
                    std::size_t stride) {
        std::fill(piece_.begin(), piece_.end(), 0.0F);
        for (std::size_t i = 0; i < window_.size(); ++i) {
            const std::ptrdiff_t at = first + static_cast<std::ptrdiff_t>(i);
            if (at >= 0 && at < std::ssize(signal))
                piece_[i] = window_[i] * signal[static_cast<std::size_t>(at)];
        }
        fft_.fwd(bins_, piece_);
        for (std::size_t k = 0; k < bins_.size(); ++k) {
            const double amplitude = 2 * static_cast<double>(std::abs(bins_[k])) / gain_;
            level[k * stride] = static_cast<float>(20 * std::log10(std::max(amplitude, 1e-15)));
        }
    }

private:
    std::vector<float> window_;
    std::vector<float> piece_;
    std::vector<std::complex<float>> bins_;
    Eigen::FFT<float> fft_;
    double gain_ = 0; // sum of the window: a sine of amplitude 1 reads gain / 2
};

} // namespace

Spectrogram spectrogram(std::span<const float> signal, double rate, int window, int columns) {
    Spectrogram s;
    s.rows = window / 2 + 1;
    s.row_height = rate / window;
    const double hop = std::max(1.0, static_cast<double>(signal.size()) / columns);
    s.columns = static_cast<int>(std::ceil(static_cast<double>(signal.size()) / hop));
    s.column_width = hop / rate;
    s.level.resize(static_cast<std::size_t>(s.rows) * static_cast<std::size_t>(s.columns));
    Column column(window, window);
    for (int c = 0; c < s.columns; ++c) {
        const auto middle = static_cast<std::ptrdiff_t>((c + 0.5) * hop);
        column(signal, middle - window / 2, s.level.data() + c,
               static_cast<std::size_t>(s.columns));
    }
    return s;
}

Spectrogram spectrum(std::span<const float> signal, double rate) {
    const int padded = static_cast<int>(std::bit_ceil(std::max<std::size_t>(signal.size(), 2)));
    Spectrogram s;
    s.rows = padded / 2 + 1;
    s.row_height = rate / padded;
    s.columns = 1;
    s.column_width = static_cast<double>(signal.size()) / rate;
    s.level.resize(static_cast<std::size_t>(s.rows));
    Column column(static_cast<int>(std::max<std::size_t>(signal.size(), 1)), padded);
    column(signal, 0, s.level.data(), 1);
    return s;
}

} // namespace plots
