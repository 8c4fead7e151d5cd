// What acts on a struck body: blows, forces that last, and what damps it.
#include "source/struck_voice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ode::sound {
namespace {

constexpr std::size_t kClick = ClickColumns::kCount;

/// What a change of the body's velocity gives the click's columns: U jumps, V and V' don't.
struct Jolt {
    std::array<double, kClick> q{}, v{};

    Jolt(const StruckVoiceModel& model, const RigidSound::Six& jerk) noexcept {
        const Vec3 all = model.rigid.dipole * jerk;
        for (std::size_t i = 0; i < 3; ++i) {
            const double own = all[static_cast<int>(i)];
            q[i] = -model.click.share * own;
            v[i] = model.click.share * model.click.forget * own;
            q[3 + i] = own;
        }
    }
    void put(std::span<float> click, std::span<float> rate) const noexcept {
        for (std::size_t i = 0; i < kClick; ++i) {
            click[i] = static_cast<float>(q[i]);
            rate[i] = static_cast<float>(v[i]);
        }
    }
};

} // namespace

bool StruckVoice::carries(double omega) const noexcept {
    return omega < 0.98 * std::numbers::pi * rate_;
}

void StruckVoice::give_rest(const Pulse& pulse) noexcept {
    const auto rest = static_cast<float>(1.0 - pulse.given);
    const auto click_rest = static_cast<float>(1.0 - pulse.click_given);
    for (std::size_t k = 0; k < pulse.push.size(); ++k)
        rate_of_[k] += rest * pulse.push[k];
    for (std::size_t k = 0; k < kClick; ++k) {
        amplitude_[k] += click_rest * pulse.click[k];
        rate_of_[k] += click_rest * pulse.click_rate[k];
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
    made.begin = time;
    made.duration = duration;
    made.given = made.click_given = 0.0;
    Jolt(*model_, jerk).put(made.click, made.click_rate);
    for (std::size_t k = 0; k < model_->omega.size(); ++k) {
        const double half = 0.5 * model_->omega[k] / rate_;
        // What the rate can't carry is left out.
        made.push[kClick + k] =
            half < 0.49 * std::numbers::pi
                ? static_cast<float>(static_cast<double>(push[k]) * half / std::sin(half))
                : 0.0f;
    }
    active_ = model_->columns;
}

void StruckVoice::drive(std::int64_t begin, std::span<const float> series,
                        std::span<const float> push, const RigidSound::Six& jerk) noexcept {
    if (drives_ == kMostDrives)
        return;
    Drive& made = drive_[drives_++];
    made.begin = begin;
    made.series = series;
    for (std::size_t k = 0; k < push.size(); ++k)
        made.push[kClick + k] = carries(model_->omega[k]) ? push[k] : 0.0f;
    Jolt(*model_, jerk).put(made.click, made.push);
    active_ = model_->columns;
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
        kicks_->push[k] = carries(model_->omega[k]) ? push[k] : 0.0;
    kicks_->modes.add(time + lead_, nullptr, kicks_->push.data());
    const Jolt jolt(*model_, jerk);
    kicks_->click.add(time, jolt.q.data(), jolt.v.data());
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
