#include "source/struck_voice.h"

#include "source/hearing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ode::sound {
namespace {

// What a blow has given a body's velocity is forgotten: later steps of ODE's change it again, and
// frequencies of some ten hertz that this makes are not heard.
constexpr double kMemory = 5e-3; // [s]

constexpr std::size_t kClick = ClickColumns::kCount;

/// A part of the way from one orientation to another; along the chord where it is short, which is
/// 1e-4 rad off at most.
Eigen::Quaterniond between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to,
                           double part) noexcept {
    constexpr double kShort = 0.99; // cosine of half the turn
    const double dot = from.dot(to);
    if (std::fabs(dot) < kShort)
        return from.slerp(part, to);
    const double sign = dot < 0.0 ? -1.0 : 1.0;
    Eigen::Quaterniond out(((1.0 - part) * from.coeffs() + sign * part * to.coeffs()).eval());
    out.normalize();
    return out;
}

/// ClickColumns::hold: integrals over half a sample each of how W, W' and U go on from a blow of 1.
void find_holds(ClickColumns& click, double sample) {
    const double w = click.omega, d = click.decay, damped = std::sqrt((w - d) * (w + d));
    const double q = -click.share, v = click.share * click.forget;
    constexpr int kParts = 64;
    for (int half = 0; half < 2; ++half) {
        ClickColumns::Hold& out = click.hold[half];
        out = {};
        for (int i = 0; i < kParts; ++i) {
            const double u = 0.5 * (half + (i + 0.5) / kParts), t = u * sample;
            const double c = std::exp(-d * t) * std::cos(damped * t);
            const double s = std::exp(-d * t) * std::sin(damped * t) / damped;
            out.q += 0.5 / kParts * (c * q + s * (d * q + v));
            out.v += 0.5 / kParts * (c * v - s * (w * w * q + d * v));
            out.u += 0.5 / kParts * std::exp(-click.forget * t);
        }
    }
}

/// Whether the rate [Hz] carries a frequency [rad/s].
bool carried(double omega, double rate) noexcept { return omega < 0.98 * std::numbers::pi * rate; }

} // namespace

void find_steps(StruckVoiceModel& model, double rate) {
    const std::size_t n = model.omega.size();
    const std::size_t all = model.columns = StruckVoice::columns_of(n);
    const double t = 1.0 / rate;
    model.step.assign(4 * all, 0.0f);
    const auto column = [&](std::size_t k, double w, double d) {
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
    };
    // T^2 V''/2 + T V' + V = U, and U' = -U / kMemory between blows: V = share U + W, where W
    // swings by itself. What is faster than half a sample is taken to be as fast.
    const double T = std::max(model.rigid.radius / model.rigid.speed, 0.5 * t);
    const double forget = 1.0 / kMemory;
    model.click = {1.0 / (1.0 - T * forget * (1.0 - 0.5 * T * forget)),
                   forget,
                   model.rigid.radius,
                   model.rigid.speed,
                   std::numbers::sqrt2 / T,
                   1.0 / T,
                   {}};
    find_holds(model.click, t);
    for (std::size_t i = 0; i < 3; ++i) {
        column(i, model.click.omega, model.click.decay);
        model.step[3 + i] = static_cast<float>(std::expm1(-forget * t));
    }
    for (std::size_t k = 0; k < n; ++k)
        column(kClick + k, model.omega[k], model.decay[k]);
    model.damped.clear();
    model.least_rate.clear();
    model.sharpen.clear();
    for (std::size_t k = 0; k < n; ++k) {
        const double w = model.omega[k], d = model.decay[k];
        model.damped.push_back(std::sqrt(std::max(0.0, (w - d) * (w + d))));
        constexpr double kBelow = 0.1; // 20 dB
        model.least_rate.push_back(kBelow * hearing_threshold(w / (2.0 * std::numbers::pi)) /
                                   (model.level[k] * w));
        model.sharpen.push_back(
            carried(w, rate) ? static_cast<float>(1.0 / SampledPulse::smoothing(w * t)) : 0.0f);
    }
    for (std::vector<double>* row : {&model.angle, &model.cosine, &model.sine})
        row->assign(n, 0.0);
    model.mend_rows.assign(2 * StruckVoice::kMostPulses * all, 0.0f);
    model.amplitude_rows.assign(ModalRun::kMost * all, 0.0f);
    model.rate_rows.assign(ModalRun::kMost * all, 0.0f);
}

StruckVoice::StruckVoice(std::shared_ptr<const StruckVoiceModel> model, double rate)
    : model_(std::move(model)), rate_(rate), lead_(model_->rigid.radius / model_->rigid.speed) {
    amplitude_.assign(model_->columns, 0.0f);
    rate_of_.assign(model_->columns, 0.0f);
    for (Pulse& pulse : pulse_)
        pulse.push.assign(model_->columns, 0.0f);
    for (Drive& drive : drive_)
        drive.push.assign(model_->columns, 0.0f);
    damped_step_ = model_->step;
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
    ring(first, samples);
    AlignedFloats &amplitude_rows = model_->amplitude_rows, &rate_rows = model_->rate_rows;
    for (int i = 0; fading && i < samples; ++i) {
        const double fade = 0.5 + 0.5 * std::cos(std::numbers::pi * share_at(i));
        const std::size_t row = static_cast<std::size_t>(i) * active_;
        for (std::size_t k = row; k < row + active_; ++k) {
            amplitude_rows[k] *= static_cast<float>(fade);
            rate_rows[k] *= static_cast<float>(fade);
        }
    }
    const double share = share_at(0), ahead = span > 0.0 ? 1.0 / (rate_ * span) : 0.0;
    const Vec3 way = to.center - pose_.center;
    ModalRun run{};
    run.sample = first * kEvery;
    run.every = kEvery;
    run.samples = samples;
    run.columns = static_cast<int>(active_);
    run.amplitude = amplitude_rows.data();
    run.rate = rate_rows.data();
    run.center = pose_.center + share * way;
    run.pace = ahead * way;
    run.rotation = between(pose_.turn, to.turn, share).toRotationMatrix();
    run.table = &model_->table;
    run.voice = this;
    run.gain = 1.0;
    run.click = &model_->click;
    out.on_modal_run(run);
}

bool StruckVoice::clicks() const noexcept {
    // d/dt (D V) at 1 m, and its derivative over the speed of sound, from U and W.
    double sum = 0.0;
    const double quick = model_->click.speed / std::max(model_->click.radius, 1e-3);
    for (std::size_t i = 0; i < 3; ++i)
        sum += model_->click.forget * std::fabs(static_cast<double>(amplitude_[3 + i])) +
               (1.0 + quick / model_->click.speed) *
                   (std::fabs(static_cast<double>(rate_of_[i])) +
                    quick * std::fabs(static_cast<double>(amplitude_[i])));
    return sum > kInaudible;
}

void StruckVoice::settle() noexcept {
    if (kicks_ && !kicks_->is_empty())
        return;
    // What pulses have begun to give is theirs.
    std::size_t least = 0;
    for (std::size_t p = 0; p < pulses_; ++p)
        least = std::max(least, pulse_[p].modes_heard);
    const std::size_t before =
        std::min(active_, kClick + model_->omega.size()) - std::min(active_, kClick);
    const std::size_t now = heard(before, least, [&](std::size_t k) {
        return std::hypot(model_->omega[k] * static_cast<double>(amplitude_[kClick + k]),
                          static_cast<double>(rate_of_[kClick + k]));
    });
    for (std::size_t k = kClick + now; k < kClick + before; ++k)
        amplitude_[k] = rate_of_[k] = 0.0f;
    if (now > 0 || pulses_ > 0 || has_next_ || clicks()) {
        active_ = columns_of(now);
    } else {
        std::fill_n(amplitude_.begin(), kClick, 0.0f);
        std::fill_n(rate_of_.begin(), kClick, 0.0f);
        active_ = 0;
    }
}

void StruckVoice::advance(const FramePose& pose, BlockSink& out) {
    const auto last = static_cast<std::int64_t>(std::floor(pose.time * rate_));
    if (!begun_) {
        begun_ = true;
        pose_ = pose;
        done_ = last;
        drives_ = 0;
        for (std::size_t p = 0; p < pulses_; ++p) {
            pulse_[p].modes.hurry(done_ + 1);
            pulse_[p].click.hurry(done_ + 1);
        }
        return;
    }
    if (kicks_)
        kicks_->close(pose.time);
    if (is_silent())
        done_ = std::max(done_, last);
    else
        run(last, pose, false, out);
    drives_ = 0;
    settle();
    pose_ = pose;
}

void StruckVoice::finish(BlockSink& out) {
    drives_ = 0; // what they point at may have gone
    kicks_.reset();
    if (is_silent())
        return;
    FramePose end = pose_;
    end.time += ModalVoice::kFadeTime;
    run(static_cast<std::int64_t>(std::floor(end.time * rate_)), end, true, out);
    std::fill(amplitude_.begin(), amplitude_.end(), 0.0f);
    std::fill(rate_of_.begin(), rate_of_.end(), 0.0f);
    active_ = pulses_ = 0;
    has_next_ = false;
    pose_ = end;
}

double StruckVoice::energy() const noexcept {
    double sum = 0.0;
    for (std::size_t k = 0; k < model_->omega.size(); ++k)
        sum += 0.5 * (std::pow(static_cast<double>(rate_of_[kClick + k]), 2) +
                      std::pow(model_->omega[k] * static_cast<double>(amplitude_[kClick + k]), 2));
    return sum;
}

} // namespace ode::sound
