#include "source/struck_voice.h"

#include "strike/pulse.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ode::sound {
namespace {

// What a blow has given a body's velocity is forgotten: later steps of ODE's change it again, and
// frequencies of some ten hertz that this makes are not heard.
constexpr double kMemory = 5e-3; // [s]

} // namespace

void find_steps(StruckVoiceModel& model, double rate) {
    const std::size_t n = model.omega.size();
    const std::size_t all = model.columns = (n + kModeLanes - 1) / kModeLanes * kModeLanes;
    model.step.assign(4 * all, 0.0f);
    for (std::size_t k = 0; k < n; ++k) {
        const double w = model.omega[k], d = model.decay[k], t = 1.0 / rate;
        const double damped =
            std::sqrt(std::max(0.0, (w - d) * (w + d))); // what creeps is no sound
        const double fade = std::exp(-d * t), s = damped > 0.0 ? std::sin(damped * t) / damped : t;
        // exp(-dt) cos - 1, without what would cancel.
        const double less = std::expm1(-d * t) * std::cos(damped * t) -
                            2.0 * std::pow(std::sin(0.5 * damped * t), 2);
        model.step[k] = static_cast<float>(less + fade * d * s);
        model.step[all + k] = static_cast<float>(fade * s);
        model.step[2 * all + k] = static_cast<float>(-fade * w * w * s);
        model.step[3 * all + k] = static_cast<float>(less - fade * d * s);
    }
}

StruckVoice::StruckVoice(std::shared_ptr<const StruckVoiceModel> model, double rate)
    : model_(std::move(model)), rate_(rate),
      way_(model_->rigid.radius / model_->rigid.speed, rate) {
    amplitude_.assign(model_->columns, 0.0f);
    rate_of_.assign(model_->columns, 0.0f);
    amplitude_rows_.assign(ModalRun::kMost * model_->columns, 0.0f);
    rate_rows_.assign(ModalRun::kMost * model_->columns, 0.0f);
    for (Pulse& pulse : pulse_)
        pulse.push.assign(model_->omega.size(), 0.0f);
}

void StruckVoice::strike(double time, double duration, std::span<const float> push,
                         const RigidSound::Six& jerk) noexcept {
    if (pulses_ == kMostPulses) {
        // All that is left of the oldest at once.
        const Pulse& oldest = pulse_.front();
        for (std::size_t k = 0; k < oldest.push.size(); ++k)
            rate_of_[k] += static_cast<float>(1.0 - oldest.given) * oldest.push[k];
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
    active_ = model_->columns;
    if (!jerked_) {
        jerked_ = true;
        velocity_.setZero();
        way_ = RigidWay(model_->rigid.radius / model_->rigid.speed, rate_);
        way_.start(static_cast<double>(done_) / rate_, velocity_);
    }
}

void StruckVoice::press(std::int64_t sample, float* row) noexcept {
    const double end = (static_cast<double>(sample) + 0.5) / rate_;
    std::size_t kept = 0;
    for (std::size_t p = 0; p < pulses_; ++p) {
        Pulse& pulse = pulse_[p];
        const double given = pulse_share((end - pulse.begin) / pulse.duration);
        const double now = given - pulse.given;
        pulse.given = given;
        if (now > 0.0) {
            for (std::size_t k = 0; k < pulse.push.size(); ++k)
                rate_of_[k] += static_cast<float>(now) * pulse.push[k];
            velocity_ += now * pulse.jerk;
        }
        if (given < 1.0)
            std::swap(pulse_[kept++], pulse);
    }
    pulses_ = kept;
    std::copy(rate_of_.begin(), rate_of_.end(), row);
}

void StruckVoice::run(std::int64_t last, const FramePose& to, bool fading, BlockSink& out) {
    while (done_ < last) {
        const int samples = static_cast<int>(std::min<std::int64_t>(ModalRun::kMost, last - done_));
        send(done_ + 1, samples, to, fading, out);
        done_ += samples;
    }
}

void StruckVoice::send(std::int64_t first, int samples, const FramePose& to, bool fading,
                       BlockSink& out) {
    const double begin = pose_.time, span = to.time - begin;
    const auto share_at = [&](int i) {
        const double time = static_cast<double>(first + i) / rate_;
        return span > 0.0 ? std::clamp((time - begin) / span, 0.0, 1.0) : 1.0;
    };
    const double forget = std::exp(-1.0 / (kMemory * rate_));
    for (int i = 0; i < samples;) {
        // Free as far as nothing presses.
        const int free = pulses_ > 0 ? 1 : samples - i;
        const std::size_t at = static_cast<std::size_t>(i) * active_;
        kernels().ring(static_cast<int>(active_), free, model_->step.data(),
                       static_cast<int>(model_->columns), amplitude_.data(), rate_of_.data(),
                       amplitude_rows_.data() + at, rate_rows_.data() + at);
        if (pulses_ > 0)
            press(first + i, rate_rows_.data() + at);
        for (const int end = i + free; i < end; ++i) {
            double fade = 1.0;
            if (fading) {
                fade = 0.5 + 0.5 * std::cos(std::numbers::pi * share_at(i));
                const std::size_t row = static_cast<std::size_t>(i) * active_;
                for (std::size_t k = row; k < row + active_; ++k) {
                    amplitude_rows_[k] *= static_cast<float>(fade);
                    rate_rows_[k] *= static_cast<float>(fade);
                }
            }
            if (!jerked_)
                continue;
            const double time = static_cast<double>(first + i) / rate_;
            velocity_ *= forget;
            way_.go_on(time, velocity_);
            way_.step_to(time);
            way_.listen(fade);
            velocities_[static_cast<std::size_t>(i)] = way_.velocity();
            slopes_[static_cast<std::size_t>(i)] = way_.slope();
        }
    }
    const double share = share_at(0), ahead = span > 0.0 ? 1.0 / (rate_ * span) : 0.0;
    const Vec3 way = to.center - pose_.center;
    ModalRun run{};
    run.sample = first;
    run.samples = samples;
    run.columns = static_cast<int>(active_);
    run.amplitude = amplitude_rows_.data();
    run.rate = rate_rows_.data();
    run.center = pose_.center + share * way;
    run.pace = ahead * way;
    run.rotation = pose_.turn.slerp(share, to.turn).toRotationMatrix();
    run.table = &model_->table;
    run.voice = this;
    run.gain = 1.0;
    run.rigid = jerked_ ? &model_->rigid : nullptr;
    run.velocity = velocities_.data();
    run.slope = slopes_.data();
    out.on_modal_run(run);
}

void StruckVoice::settle() noexcept {
    if (pulses_ > 0)
        return;
    // A body that moves steadily makes no sound; this is what is left of having forgotten a blow.
    constexpr double kStill = 1e-5; // of 1 m/s, and of its radius times 1 /s
    if (velocity_.head<3>().norm() + model_->rigid.radius * velocity_.tail<3>().norm() < kStill)
        jerked_ = false;
    std::size_t heard = std::min(active_, model_->omega.size());
    while (heard > 0) {
        const std::size_t k = heard - 1;
        const double w = model_->omega[k], v = static_cast<double>(rate_of_[k]);
        if (model_->level[k] * std::hypot(w * static_cast<double>(amplitude_[k]), v) * w >
            kInaudible)
            break;
        amplitude_[k] = rate_of_[k] = 0.0f;
        --heard;
    }
    active_ = (heard + kModeLanes - 1) / kModeLanes * kModeLanes;
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
    std::fill(amplitude_.begin(), amplitude_.end(), 0.0f);
    std::fill(rate_of_.begin(), rate_of_.end(), 0.0f);
    active_ = pulses_ = 0;
    jerked_ = false;
    pose_ = end;
}

double StruckVoice::energy() const noexcept {
    double sum = 0.0;
    for (std::size_t k = 0; k < model_->omega.size(); ++k)
        sum += 0.5 * (std::pow(static_cast<double>(rate_of_[k]), 2) +
                      std::pow(model_->omega[k] * static_cast<double>(amplitude_[k]), 2));
    return sum;
}

} // namespace ode::sound
