#include "source/struck_voice.h"

#include "strike/pulse.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ode::sound {
namespace {

// What a blow has given a body's velocity is forgotten: later steps of ODE's change it again, and
// frequencies of some hertz that this makes are not heard.
constexpr double kMemory = 0.02; // [s]

} // namespace

StruckVoice::StruckVoice(std::shared_ptr<const StruckVoiceModel> model, double rate)
    : model_(std::move(model)), rate_(rate), resonators_(model_->omega, model_->decay, rate),
      way_(model_->rigid.radius / model_->rigid.speed, rate) {
    const std::size_t n = model_->omega.size();
    amplitude_.assign(n, 0.0);
    rate_of_.assign(n, 0.0);
    sent_amplitude_.assign(n, 0.0f);
    sent_rate_.assign(n, 0.0f);
    for (Pulse& pulse : pulse_)
        pulse.push.assign(n, 0.0f);
}

void StruckVoice::strike(double time, double duration, std::span<const float> push,
                         const RigidSound::Six& jerk) noexcept {
    if (pulses_ == kMostPulses) {
        // All that is left of the oldest at once.
        const Pulse& oldest = pulse_.front();
        for (std::size_t k = 0; k < rate_of_.size(); ++k)
            rate_of_[k] += (1.0 - oldest.given) * static_cast<double>(oldest.push[k]);
        velocity_ += (1.0 - oldest.given) * oldest.jerk;
        std::rotate(pulse_.begin(), pulse_.begin() + 1, pulse_.end());
        --pulses_;
    }
    Pulse& made = pulse_[pulses_++];
    made.begin = time;
    made.duration = duration;
    made.given = 0.0;
    made.jerk = jerk;
    for (std::size_t k = 0; k < made.push.size(); ++k) {
        const double half = 0.5 * model_->omega[k] / rate_;
        made.push[k] = static_cast<float>(static_cast<double>(push[k]) * half / std::sin(half));
    }
    active_ = rate_of_.size();
    if (!jerked_) {
        jerked_ = true;
        velocity_.setZero();
        way_ = RigidWay(model_->rigid.radius / model_->rigid.speed, rate_);
        way_.start(static_cast<double>(done_) / rate_, velocity_);
    }
}

void StruckVoice::press(std::int64_t sample) noexcept {
    const double end = (static_cast<double>(sample) + 0.5) / rate_;
    std::size_t kept = 0;
    for (std::size_t p = 0; p < pulses_; ++p) {
        Pulse& pulse = pulse_[p];
        const double given = pulse_share((end - pulse.begin) / pulse.duration);
        const double now = given - pulse.given;
        pulse.given = given;
        if (now > 0.0) {
            for (std::size_t k = 0; k < rate_of_.size(); ++k)
                rate_of_[k] += now * static_cast<double>(pulse.push[k]);
            velocity_ += now * pulse.jerk;
        }
        if (given < 1.0)
            std::swap(pulse_[kept++], pulse);
    }
    pulses_ = kept;
}

void StruckVoice::run(std::int64_t last, const FramePose& to, bool fading, BlockSink& out) {
    const double begin = pose_.time, span = to.time - begin;
    const double forget = std::exp(-1.0 / (kMemory * rate_));
    for (std::int64_t sample = done_ + 1; sample <= last; ++sample) {
        resonators_.tick(amplitude_.data(), rate_of_.data());
        if (pulses_ > 0)
            press(sample);
        const double time = static_cast<double>(sample) / rate_;
        const double share = span > 0.0 ? std::clamp((time - begin) / span, 0.0, 1.0) : 1.0;
        const double fade = fading ? 0.5 + 0.5 * std::cos(std::numbers::pi * share) : 1.0;
        for (std::size_t k = 0; k < active_; ++k) {
            sent_amplitude_[k] = static_cast<float>(fade * amplitude_[k]);
            sent_rate_[k] = static_cast<float>(fade * rate_of_[k]);
        }
        const Vec3 center = pose_.center + share * (to.center - pose_.center);
        ModalBlock block{sample,
                         center,
                         pose_.turn.slerp(share, to.turn).toRotationMatrix(),
                         sent_amplitude_,
                         sent_rate_,
                         &model_->table,
                         this,
                         1.0};
        if (jerked_) {
            velocity_ *= forget;
            way_.go_on(time, velocity_);
            way_.step_to(time);
            way_.listen(fade);
            block.rigid = &model_->rigid;
            block.velocity = way_.velocity();
            block.slope = way_.slope();
        }
        out.on_modes(block);
    }
    done_ = std::max(done_, last);
}

void StruckVoice::settle() noexcept {
    if (pulses_ > 0)
        return;
    // A body that moves steadily makes no sound; this is what is left of having forgotten a blow.
    constexpr double kStill = 1e-6; // of 1 m/s, and of its radius times 1 /s
    if (velocity_.head<3>().norm() + model_->rigid.radius * velocity_.tail<3>().norm() < kStill)
        jerked_ = false;
    std::size_t heard = active_;
    while (heard > 0) {
        const std::size_t k = heard - 1;
        const double w = model_->omega[k];
        if (model_->level[k] * std::hypot(w * amplitude_[k], rate_of_[k]) * w > kInaudible)
            break;
        amplitude_[k] = rate_of_[k] = 0.0;
        sent_amplitude_[k] = sent_rate_[k] = 0.0f;
        --heard;
    }
    active_ = heard;
}

void StruckVoice::advance(const FramePose& pose, BlockSink& out) {
    const auto last = static_cast<std::int64_t>(std::floor(pose.time * rate_));
    if (!begun_) {
        begun_ = true;
        pose_ = pose;
        done_ = last;
        return;
    }
    if (is_silent())
        done_ = std::max(done_, last);
    else
        run(last, pose, false, out);
    settle();
    pose_ = pose;
}

void StruckVoice::finish(BlockSink& out) {
    if (is_silent())
        return;
    FramePose end = pose_;
    end.time += ModalVoice::kFadeTime;
    run(static_cast<std::int64_t>(std::floor(end.time * rate_)), end, true, out);
    std::fill(amplitude_.begin(), amplitude_.end(), 0.0);
    std::fill(rate_of_.begin(), rate_of_.end(), 0.0);
    active_ = pulses_ = 0;
    jerked_ = false;
    pose_ = end;
}

double StruckVoice::energy() const noexcept {
    double sum = 0.0;
    for (std::size_t k = 0; k < rate_of_.size(); ++k)
        sum += 0.5 * (std::pow(rate_of_[k], 2) + std::pow(model_->omega[k] * amplitude_[k], 2));
    return sum;
}

} // namespace ode::sound
