// What acts on a struck body: blows, forces that last, and what damps it.
#include "source/struck_voice.h"

#include "strike/pulse.h"
#include "transfer/wave.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode::sound {
namespace {

constexpr std::size_t kClick = ClickColumns::kCount;

} // namespace

void StruckVoice::give_rest(const Pulse& pulse) noexcept {
    const auto rest = static_cast<float>(pulse.modes.rest(done_ + 1));
    const auto click_rest = static_cast<float>(pulse.click.rest(done_ + 1));
    for (std::size_t k = 0; k < pulse.push.size(); ++k)
        rate_of_[k] += rest * pulse.push[k];
    for (std::size_t i = 0; i < 3; ++i)
        for (const ClickColumns::Hold& hold : model_->click.hold) {
            const float own = click_rest * static_cast<float>(pulse.jolt[static_cast<int>(i)]);
            amplitude_[i] += static_cast<float>(hold.q) * own;
            rate_of_[i] += static_cast<float>(hold.v) * own;
            amplitude_[3 + i] += static_cast<float>(hold.u) * own;
        }
}

/// What the samples of a short pulse have given each mode at their last, against what the pulse
/// has: its spectrum at the mode's frequency, come at mid-time, gone on to that sample.
void StruckVoice::mend(const Pulse& pulse, float* mend_q, float* mend_v) const noexcept {
    const StruckVoiceModel& model = *model_;
    const std::size_t n = model.omega.size(), all = model.columns;
    float series[2 * static_cast<std::size_t>(SampledPulse::kShort)];
    const auto samples = static_cast<int>(pulse.modes.end() - pulse.modes.first());
    pulse.modes.read(pulse.modes.first(), samples, series);
    float *const q = mend_q + kClick, *const v = mend_v + kClick;
    const float *const step = model.step.data() + kClick, *const push = pulse.push.data() + kClick;
    std::fill_n(q, n, 0.0f);
    std::fill_n(v, n, 0.0f);
    for (int s = 0; s < samples; ++s)
        for (std::size_t k = 0; k < n; ++k) {
            const float x = q[k], y = v[k];
            q[k] = x + (step[k] * x + step[all + k] * y);
            v[k] = y + (step[2 * all + k] * x + step[3 * all + k] * y) + series[s] * push[k];
        }
    const double passed =
        (static_cast<double>(pulse.modes.end() - 1) - pulse.modes.middle()) / rate_;
    const double duration = pulse.modes.duration() / rate_;
    for (std::size_t k = 0; k < n; ++k)
        model.angle[k] = model.damped[k] * passed;
    turn(model.angle.data(), static_cast<int>(n), model.cosine.data(), model.sine.data());
    for (std::size_t k = 0; k < n; ++k) {
        const double w = model.damped[k], d = model.decay[k];
        if (!(w > 0.0) || model.sharpen[k] == 0.0f) {
            q[k] = v[k] = 0.0f;
            continue;
        }
        // The spectrum at a complex frequency, to the first order of what decays meanwhile.
        const PulseSpectrum spectrum = pulse_spectrum(w * duration);
        const double real = spectrum.value, imag = d * duration * spectrum.slope;
        const double size = std::exp(-d * passed) * static_cast<double>(push[k]) /
                            static_cast<double>(model.sharpen[k]);
        const double c = size * (model.cosine[k] * real - model.sine[k] * imag);
        const double s = size * (model.sine[k] * real + model.cosine[k] * imag);
        q[k] = static_cast<float>(s / w - static_cast<double>(q[k]));
        v[k] = static_cast<float>(c - d / w * s - static_cast<double>(v[k]));
    }
}

void StruckVoice::strike(double time, double duration, std::span<const float> push,
                         const RigidSound::Six& jerk) noexcept {
    if (pulses_ == kMostPulses) {
        // All that is left of the oldest at once.
        give_rest(pulse_.front());
        std::rotate(pulse_.begin(), pulse_.begin() + 1, pulse_.end());
        --pulses_;
    }
    Pulse& made = pulse_[pulses_++];
    const StruckVoiceModel& model = *model_;
    const std::size_t n = model.omega.size();
    const double begin = (time + lead_) * rate_, samples = duration * rate_;
    const bool at_once = n > 0 && model.omega.front() * duration > kLong;
    using Window = SampledPulse::Window;
    if (at_once)
        made.modes.aim(begin + 0.5 * samples - 0.5, 1.0, Window::kSmooth);
    else
        made.modes.aim(begin, samples, Window::kSmooth);
    made.click.aim(time * rate_, samples, Window::kFlat);
    made.modes.hurry(done_ + 1);
    made.click.hurry(done_ + 1);
    made.jolt = model.rigid.dipole * jerk;
    const bool smoothed = made.modes.is_short();
    float* const own = made.push.data() + kClick;
    for (std::size_t k = 0; k < n; ++k) {
        const float sharpen = model.sharpen[k];
        own[k] = smoothed ? sharpen * push[k] : sharpen > 0.0f ? push[k] : 0.0f;
        if (at_once)
            own[k] *= static_cast<float>(pulse_spectrum(model.omega[k] * duration).value /
                                         pulse_spectrum(model.omega[k] / rate_).value);
    }
    made.modes_heard = heard(n, 0, [&](std::size_t k) {
        return std::fabs(static_cast<double>(push[k]) *
                         pulse_spectrum(model.omega[k] * duration).value);
    });
    active_ = std::max(active_, columns_of(made.modes_heard));
}

void StruckVoice::drive(std::int64_t begin, std::span<const float> series,
                        std::span<const float> push, const RigidSound::Six& jerk) noexcept {
    if (drives_ == kMostDrives)
        return;
    Drive& made = drive_[drives_++];
    made.begin = begin;
    made.series = series;
    for (std::size_t k = 0; k < push.size(); ++k)
        made.push[kClick + k] = model_->sharpen[k] > 0.0f ? push[k] : 0.0f;
    made.jolt = model_->rigid.dipole * jerk;
    double most = 0.0; // if it came all at once
    for (const float share : series)
        most += std::fabs(static_cast<double>(share));
    made.modes_heard = heard(push.size(), 0, [&](std::size_t k) {
        return most * std::fabs(static_cast<double>(push[k]));
    });
    active_ = std::max(active_, columns_of(made.modes_heard));
}

void StruckVoice::push(double time, std::span<const double> push, const RigidSound::Six& jerk) {
    if (!kicks_) {
        std::vector<Kicks::Column> mode, whole;
        for (std::size_t k = 0; k < model_->omega.size(); ++k)
            mode.push_back({model_->omega[k], model_->decay[k]});
        for (std::size_t i = 0; i < kClick; ++i) {
            const bool swings = i < kClick / 2;
            whole.push_back({swings ? model_->click.omega : 0.0,
                             swings ? model_->click.decay : model_->click.forget});
        }
        kicks_ = std::make_unique<Given>(Given{Kicks(std::move(mode), rate_),
                                               Kicks(std::move(whole), rate_),
                                               std::vector<double>(model_->omega.size())});
    }
    for (std::size_t k = 0; k < push.size(); ++k)
        kicks_->push[k] = model_->sharpen[k] > 0.0f ? push[k] : 0.0;
    kicks_->modes.add(time + lead_, nullptr, kicks_->push.data());
    // U jumps, V and V' don't.
    const Vec3 all = model_->rigid.dipole * jerk;
    double q[kClick] = {}, v[kClick] = {};
    for (std::size_t i = 0; i < 3; ++i) {
        q[3 + i] = all[static_cast<int>(i)];
        q[i] = -model_->click.share * q[3 + i];
        v[i] = model_->click.share * model_->click.forget * q[3 + i];
    }
    kicks_->click.add(time, q, v);
    active_ = model_->columns;
}

void StruckVoice::damp(std::span<const float> decay) noexcept {
    damped_ = !decay.empty();
    const std::size_t all = model_->columns;
    const auto lapse = static_cast<float>(1.0 / rate_);
    const float* const step = model_->step.data() + kClick;
    float* const out = damped_step_.data() + kClick;
    for (std::size_t k = 0; k < decay.size(); ++k) {
        // The step's matrix times g, of which changes are kept: g (1 + a) - 1 = a + less (1 + a).
        // less = exp(-x) - 1: four terms, 1e-5 of it off at most where x is 0.2, and more there is
        // as little to be heard of.
        const float x = std::min(decay[k] * lapse, 1.0f);
        const float less = -x * (1.0f - x * (0.5f - x * (1.0f / 6 - x * (1.0f / 24 - x / 120))));
        for (std::size_t row = 0; row < 4; ++row) {
            const float own = step[row * all + k];
            out[row * all + k] = own + less * (own + (row == 0 || row == 3 ? 1.0f : 0.0f));
        }
    }
}

} // namespace ode::sound
