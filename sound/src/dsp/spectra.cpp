#include "dsp/spectra.h"

#include "dsp/kaiser.h"

#include <Eigen/Dense>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kAttenuation = 100.0;

using Bins = std::vector<std::complex<double>>;

struct Windowed {
    Bins bins;
    double sum;    ///< of the window
    double energy; ///< of the window
};

Windowed transform(std::span<const double> samples) {
    Windowed out{{}, 0.0, 0.0};
    const double beta = kaiser_beta(kAttenuation);
    std::vector<double> padded(std::bit_ceil(samples.size()), 0.0);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double u = 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(samples.size());
        const double w = kaiser(u - 1.0, beta);
        padded[i] = w * samples[i];
        out.sum += w;
        out.energy += w * w;
    }
    Eigen::FFT<double> fft;
    fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    fft.fwd(out.bins, padded);
    return out;
}

} // namespace

Spectrum::Spectrum(std::span<const double> samples, double rate) {
    if (samples.size() < 16)
        return;
    const Windowed t = transform(samples);
    const auto padded = static_cast<double>(std::bit_ceil(samples.size()));
    bin_width_ = rate / padded;
    // First zero of the Kaiser window's transform: f = sqrt(1 + (beta/pi)^2) / length.
    const double beta = kaiser_beta(kAttenuation);
    lobe_ = std::hypot(1.0, beta / std::numbers::pi) * rate / static_cast<double>(samples.size());
    amplitude_.reserve(t.bins.size());
    for (const std::complex<double>& bin : t.bins)
        amplitude_.push_back(2.0 * std::abs(bin) / t.sum);
    amplitude_.front() *= 0.5;
}

Peak Spectrum::refine(std::size_t bin) const {
    const double at = static_cast<double>(bin) * bin_width_;
    if (bin == 0 || bin + 1 >= amplitude_.size())
        return {at, amplitude_[bin]};
    const double least = 1e-300;
    const double a = std::log(std::max(amplitude_[bin - 1], least));
    const double b = std::log(std::max(amplitude_[bin], least));
    const double c = std::log(std::max(amplitude_[bin + 1], least));
    const double curve = a - 2.0 * b + c;
    const double shift = curve < 0.0 ? std::clamp(0.5 * (a - c) / curve, -0.5, 0.5) : 0.0;
    return {at + shift * bin_width_, std::exp(b - 0.25 * (a - c) * shift)};
}

Peak Spectrum::strongest(double low, double high) const {
    const std::vector<Peak> found = peaks(low, high, 1);
    return found.empty() ? Peak{0.0, 0.0} : found.front();
}

std::vector<Peak> Spectrum::peaks(double low, double high, int count) const {
    std::vector<std::size_t> tops;
    for (std::size_t i = 1; i + 1 < amplitude_.size(); ++i) {
        const double at = static_cast<double>(i) * bin_width_;
        if (at >= low && at <= high && amplitude_[i] >= amplitude_[i - 1] &&
            amplitude_[i] > amplitude_[i + 1])
            tops.push_back(i);
    }
    std::sort(tops.begin(), tops.end(),
              [&](std::size_t a, std::size_t b) { return amplitude_[a] > amplitude_[b]; });
    std::vector<Peak> out;
    for (const std::size_t top : tops) {
        if (static_cast<int>(out.size()) >= count)
            break;
        const Peak peak = refine(top);
        const bool apart = std::all_of(out.begin(), out.end(), [&](const Peak& other) {
            return std::abs(other.frequency - peak.frequency) > lobe_;
        });
        if (apart)
            out.push_back(peak);
    }
    return out;
}

double band_rms(std::span<const double> samples, double rate, double low, double high) {
    if (samples.size() < 16)
        return 0.0;
    const Windowed t = transform(samples);
    const auto padded = static_cast<double>(std::bit_ceil(samples.size()));
    double power = 0.0; // Parseval: sum |X|^2 = padded * sum (w x)^2, both halves of the spectrum
    for (std::size_t k = 0; k < t.bins.size(); ++k) {
        const double at = static_cast<double>(k) * rate / padded;
        const bool lone = k == 0 || k + 1 == t.bins.size();
        if (at >= low && at <= high)
            power += (lone ? 1.0 : 2.0) * std::norm(t.bins[k]);
    }
    return std::sqrt(power / (padded * t.energy));
}

std::complex<double> phasor(std::span<const double> samples, double rate, double frequency) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const double omega = 2.0 * std::numbers::pi * frequency / rate;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto t = static_cast<double>(i);
        const double u = (t + 0.5) / static_cast<double>(samples.size());
        const double w = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * u);
        const Eigen::Vector3d basis(std::cos(omega * t), -std::sin(omega * t), 1.0);
        normal += w * basis * basis.transpose();
        right += w * samples[i] * basis;
    }
    const Eigen::Vector3d fit = normal.ldlt().solve(right);
    return {fit[0], fit[1]};
}

} // namespace ode::sound
