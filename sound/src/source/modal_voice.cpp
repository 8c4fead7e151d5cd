#include "source/modal_voice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ode::sound {
namespace {

RigidSound::Six velocity_in_frame(const ModalView& view) {
    RigidSound::Six out;
    out << view.rotation.transpose() * view.velocity, view.rotation.transpose() * view.spin;
    return out;
}

/// Between two rotations that are less than a radian apart: their mean by weight, made orthonormal
/// by one step of Newton's to some 1e-7 for a twentieth of a radian.
Eigen::Matrix3d between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to, double share) {
    const Eigen::Matrix3d mean = from + share * (to - from);
    return mean * (1.5 * Eigen::Matrix3d::Identity() - 0.5 * mean.transpose() * mean);
}

} // namespace

ModalVoice::ModalVoice(std::shared_ptr<const ModalVoiceModel> model, double rate)
    : model_(std::move(model)), rate_(rate), resonators_(model_->omega, model_->decay, rate),
      undamped_(model_->omega, std::vector<double>(model_->omega.size(), 0.0), rate),
      way_(model_->rigid.radius / model_->rigid.speed, rate) {
    const std::size_t n = model_->omega.size();
    for (AlignedVector* own :
         {&amplitude_, &rate_of_, &break_amplitude_, &break_rate_, &ring_amplitude_, &ring_rate_,
          &miss_amplitude_, &miss_rate_, &held_amplitude_, &held_rate_})
        own->assign(n, 0.0);
    sent_amplitude_.assign(n, 0.0f);
    sent_rate_.assign(n, 0.0f);
}

double ModalVoice::fade_at(double time) const noexcept {
    const double u = std::clamp((time - fade_begin_) / kFadeTime, 0.0, 1.0);
    return 0.5 * (1.0 + std::cos(std::numbers::pi * u));
}

void ModalVoice::emit(std::int64_t sample, const double* amplitude, const double* rate,
                      BlockSink& out) {
    const double time = static_cast<double>(sample) / rate_;
    const double fade = fade_at(time);
    const double sign = state_ == State::kFading ? 1.0 : -1.0;
    const bool fades = (entering_ || state_ == State::kFading) && fade > 0.0;
    for (std::size_t k = 0; k < heard_; ++k) {
        const double shift = fades ? sign * fade : 0.0;
        sent_amplitude_[k] = static_cast<float>(amplitude[k] + shift * break_amplitude_[k]);
        sent_rate_[k] = static_cast<float>(rate[k] + shift * break_rate_[k]);
    }
    double heard = 1.0; // of the motion as a whole
    if (entering_)
        heard -= fade;
    else if (state_ == State::kFading)
        heard = fade;
    way_.listen(heard);
    out.on_modes({sample,
                  center_,
                  rotation_,
                  {sent_amplitude_.data(), heard_},
                  {sent_rate_.data(), heard_},
                  &model_->table,
                  this,
                  1.0,
                  nullptr,
                  &model_->rigid,
                  way_.velocity(),
                  way_.slope()});
}

std::size_t ModalVoice::audible(const ModalView& view, double nearest) const noexcept {
    const double least =
        kInaudible * std::max(nearest - model_->table.radius, model_->table.near_limit());
    std::size_t heard = modes();
    for (; heard > 0; --heard) {
        const std::size_t k = heard - 1;
        const double w = model_->omega[k];
        if (model_->level[k] * std::hypot(w * view.amplitude[k], view.rate[k]) * w > least)
            break;
    }
    return heard;
}

void ModalVoice::start(const ModalView& view) {
    std::copy(view.amplitude.begin(), view.amplitude.end(), amplitude_.begin());
    std::copy(view.rate.begin(), view.rate.end(), rate_of_.begin());
    break_amplitude_ = amplitude_;
    break_rate_ = rate_of_;
    fade_begin_ = view.time;
    entering_ = true;
    state_ = State::kRinging;
    seen_ = view.time;
    before_ = view.center;
    way_.start(view.time, velocity_in_frame(view));
}

// A push comes at the beginning of what a view tells of: from there to its end the modes rang.
void ModalVoice::ring_back(const ModalView& view, std::int64_t sample, BlockSink& out) {
    std::copy(view.amplitude.begin(), view.amplitude.end(), held_amplitude_.begin());
    std::copy(view.rate.begin(), view.rate.end(), held_rate_.begin());
    resonators_.evolve(static_cast<double>(sample) / rate_ - view.time, heard_,
                       held_amplitude_.data(), held_rate_.data());
    emit_at(view, sample, out);
}

void ModalVoice::ring_on(const ModalView& view, std::int64_t first, std::int64_t last,
                         BlockSink& out) {
    const double lead = static_cast<double>(first) / rate_ - seen_;
    const double span = view.time - seen_;
    ring_amplitude_ = amplitude_;
    ring_rate_ = rate_of_;
    resonators_.evolve(lead, heard_, ring_amplitude_.data(), ring_rate_.data());
    // What free ringing misses (a push, modes that a spin has mixed) comes in little by little.
    miss_amplitude_ = amplitude_;
    miss_rate_ = rate_of_;
    resonators_.evolve(span, heard_, miss_amplitude_.data(), miss_rate_.data());
    for (std::size_t k = 0; k < heard_; ++k) {
        miss_amplitude_[k] = view.amplitude[k] - miss_amplitude_[k];
        miss_rate_[k] = view.rate[k] - miss_rate_[k];
    }
    undamped_.evolve(lead - span, heard_, miss_amplitude_.data(), miss_rate_.data());
    for (std::int64_t sample = first; sample <= last; ++sample) {
        const double share = (static_cast<double>(sample) / rate_ - seen_) / span;
        for (std::size_t k = 0; k < heard_; ++k) {
            held_amplitude_[k] = ring_amplitude_[k] + share * miss_amplitude_[k];
            held_rate_[k] = ring_rate_[k] + share * miss_rate_[k];
        }
        emit_at(view, sample, out);
        resonators_.tick(heard_, ring_amplitude_.data(), ring_rate_.data());
        undamped_.tick(heard_, miss_amplitude_.data(), miss_rate_.data());
    }
}

void ModalVoice::emit_at(const ModalView& view, std::int64_t sample, BlockSink& out) {
    const double time = static_cast<double>(sample) / rate_;
    const double share = (time - seen_) / (view.time - seen_);
    center_ = before_ + share * (view.center - before_);
    rotation_ = between(turned_, view.rotation, share); // a turn by steps would be heard as a buzz
    way_.step_to(time);
    emit(sample, held_amplitude_.data(), held_rate_.data(), out);
}

void ModalVoice::push(const ModalView& view, double nearest, BlockSink& out) {
    const std::size_t now = audible(view, nearest);
    heard_ = std::max(now, heard_at_view_);
    heard_at_view_ = now;
    if (state_ != State::kRinging || view.time - view.dt > seen_ + 0.5 * view.dt) {
        heard_ = now;
        start(view);
        center_ = view.center;
        rotation_ = turned_ = view.rotation;
        return;
    }
    const auto first = static_cast<std::int64_t>(std::floor(seen_ * rate_)) + 1;
    const auto last = static_cast<std::int64_t>(std::floor(view.time * rate_));
    way_.go_on(view.time, velocity_in_frame(view));
    if (first == last)
        ring_back(view, first, out);
    else if (first < last)
        ring_on(view, first, last, out);
    std::copy(view.amplitude.begin(), view.amplitude.end(), amplitude_.begin());
    std::copy(view.rate.begin(), view.rate.end(), rate_of_.begin());
    entering_ = entering_ && view.time < fade_begin_ + kFadeTime;
    seen_ = view.time;
    before_ = center_ = view.center;
    turned_ = rotation_ = view.rotation;
}

void ModalVoice::advance_to(double time, BlockSink& out) {
    constexpr double kRounding = 1e-9; // [s] of the step's end
    if (state_ == State::kRinging && time > seen_ + kRounding) {
        break_amplitude_ = amplitude_;
        break_rate_ = rate_of_;
        fade_begin_ = seen_;
        state_ = State::kFading;
    }
    if (state_ != State::kFading)
        return;
    std::fill(held_amplitude_.begin(), held_amplitude_.end(), 0.0);
    std::fill(held_rate_.begin(), held_rate_.end(), 0.0);
    const auto last = static_cast<std::int64_t>(std::floor(time * rate_));
    for (auto sample = static_cast<std::int64_t>(std::floor(seen_ * rate_)) + 1; sample <= last;
         ++sample)
        if (static_cast<double>(sample) / rate_ <= fade_begin_ + kFadeTime)
            emit(sample, held_amplitude_.data(), held_rate_.data(), out);
    seen_ = std::max(seen_, time);
    if (seen_ > fade_begin_ + kFadeTime)
        state_ = State::kSilent;
}

} // namespace ode::sound
