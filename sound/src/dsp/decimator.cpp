#include "dsp/decimator.h"

#include "dsp/kaiser.h"
#include "dsp/kernels.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

constexpr double kAttenuation = 103.0; // 3 dB in hand for the formulas' fit

} // namespace

int Decimator::reach_for(double rate) noexcept {
    const double transition = (stop_edge(rate) - pass_edge(rate)) / (2.0 * rate);
    return kaiser_length(kAttenuation, transition) / 2;
}

double Decimator::pass_edge(double rate) noexcept {
    return rate >= 48000.0 ? rate * 5.0 / 12.0 : std::min(20000.0, rate * 5.0 / 11.0);
}

double Decimator::stop_edge(double rate) noexcept {
    return rate >= 48000.0 ? 0.5 * rate : rate - pass_edge(rate);
}

Decimator::Decimator(double rate, Kind kind, double gain) {
    const double input_rate = 2.0 * rate;
    const double pass = pass_edge(rate) / input_rate;
    const double stop = stop_edge(rate) / input_rate;
    const double cut = pass + stop; // twice the middle of the transition, cycles per sample
    reach_ = reach_for(rate);

    const int length = 2 * reach_ + 1;
    tap_.assign(static_cast<std::size_t>((length + 3) / 4) * 4, 0.0);
    const double beta = kaiser_beta(kAttenuation);
    double unit = 0.0; // response at frequency 0, of the value or of the slope
    for (int i = 0; i < length; ++i) {
        const double lag = reach_ - i; // output minus input time [samples]
        const double window = kaiser(lag / (reach_ + 1), beta);
        double& tap = tap_[static_cast<std::size_t>(i)];
        if (kind == Kind::kSmooth) {
            tap = sinc(cut * lag) * window;
            unit += tap;
        } else {
            tap = sinc_slope(cut * lag) * window;
            unit -= tap * lag / input_rate;
        }
    }
    for (double& tap : tap_)
        tap *= gain / unit;
}

double Decimator::operator()(const double* first) const noexcept {
    return kernels().dot(tap_.data(), first, static_cast<int>(tap_.size()));
}

} // namespace ode::sound
