#include "mix/voice_gains.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

VoiceGains::VoiceGains(const TransferTable& table, std::size_t lead)
    : now_(table.mode.size()), next_(table.mode.size()), lead_(lead),
      lobes_(std::sqrt(static_cast<double>(table.lobes()))) {
    const std::size_t lanes = (lead + now_.size() + kModeLanes - 1) / kModeLanes * kModeLanes;
    for (AlignedFloats* row : {&velocity_, &acceleration_, &velocity_step_, &acceleration_step_})
        row->assign(lanes, 0.0f);
}

double VoiceGains::lobe(const Vec3& place) const noexcept { return place.norm() / lobes_; }

double VoiceGains::share(std::int64_t sample) const noexcept {
    return std::min(1.0, static_cast<double>(sample - looked_) / static_cast<double>(ramp_));
}

bool VoiceGains::look(std::int64_t sample, const TransferTable& table, const Vec3& place,
                      std::int64_t longest) noexcept {
    const std::int64_t since = sample - looked_;
    const bool anew = !known_ || since <= 0 || since > 64 * kInterval;
    const double come = anew ? 1.0 : share(sample);
    pace_ = anew ? Vec3::Zero() : Vec3((place - seen_) / static_cast<double>(since));
    seen_ = place;
    looked_ = sample;
    ramp_ = longest;
    if (kLeap * lobe(place) < pace_.norm() * static_cast<double>(longest))
        ramp_ = std::max<std::int64_t>(
            kInterval, static_cast<std::int64_t>(kLeap * lobe(place) / pace_.norm()));
    const Vec3 there = place + static_cast<double>(ramp_) * pace_;
    const bool same = known_ && come == 1.0 && (there - place_).norm() < kSame * lobe(place);
    if (same) {
        turns_ = false;
        now_ = next_;
    } else {
        for (std::size_t k = 0; turns_ && k < now_.size(); ++k) {
            const auto part = static_cast<float>(come);
            now_[k].velocity += part * (next_[k].velocity - now_[k].velocity);
            now_[k].acceleration += part * (next_[k].acceleration - now_[k].acceleration);
        }
        if (!turns_)
            now_.swap(next_);
        table.gains(there, next_);
        if (anew)
            now_ = next_;
        known_ = true;
        turns_ = !anew;
        place_ = there;
    }
    for (std::size_t k = 0; k < now_.size(); ++k) {
        velocity_[lead_ + k] = now_[k].velocity;
        acceleration_[lead_ + k] = now_[k].acceleration;
        velocity_step_[lead_ + k] = next_[k].velocity - now_[k].velocity;
        acceleration_step_[lead_ + k] = next_[k].acceleration - now_[k].acceleration;
    }
    return !same;
}

double VoiceGains::flow(const ModalBlock& block, const Vec3& ear) noexcept {
    const std::int64_t since = block.sample - looked_;
    if (!known_ || since < 0 || since >= watched_ + kInterval) {
        watched_ = since;
        const Vec3 place = block.rotation.transpose() * (ear - block.center);
        const Vec3 off = place - seen_ - static_cast<double>(since) * pace_;
        if (!known_ || since < 0 || since >= ramp_ || off.norm() > kSame * lobe(place)) {
            look(block.sample, *block.table, place, kLongest);
            watched_ = 0;
        }
    }
    constexpr std::size_t kLanes = 8;
    float sum[kLanes] = {}, change[kLanes] = {};
    const auto add = [&](std::size_t k, std::size_t lane) {
        const float q = block.amplitude[k], v = block.rate[k];
        sum[lane] += velocity_[k] * q + acceleration_[k] * v;
        change[lane] += velocity_step_[k] * q + acceleration_step_[k] * v;
    };
    std::size_t k = 0;
    for (; k + kLanes <= block.amplitude.size(); k += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            add(k + lane, lane);
    for (; k < block.amplitude.size(); ++k)
        add(k, 0);
    double all = 0.0, slope = 0.0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        all += static_cast<double>(sum[lane]);
        slope += static_cast<double>(change[lane]);
    }
    const Vec3 centre = block.center + block.rotation * block.table->centre;
    return (all + share(block.sample) * slope) * (ear - centre).norm();
}

void VoiceGains::look_again(const ModalRun& run, const Vec3& ear, double allowance) noexcept {
    const auto cost = static_cast<double>(run.table->coefficient.size());
    credit_ = std::min(credit_ + allowance * run.samples * run.every, 2.0 * cost);
    const std::int64_t since = run.sample - looked_;
    const bool asks = since >= kInterval && credit_ >= cost;
    if (known_ && !asks && since >= 0)
        return;
    if (look(run.sample, *run.table, run.rotation.transpose() * (ear - run.center),
             std::clamp<std::int64_t>(since, kInterval, kLongest)))
        credit_ -= cost;
}

void VoiceGains::pressure_flow(const ModalRun& run, std::span<VoiceGains* const> gains,
                               std::span<const Vec3> ear, double allowance,
                               float* const* out) noexcept {
    // Gains at the begin and their change, each a row: what is heard is begin + u change, u from
    // u_begin on by u_step.
    const std::size_t ears = gains.size();
    const float* by[4][2];
    float change[2][ModalRun::kMost];
    float* sum[4];
    double u_begin[2], u_step[2];
    const ClickColumns& click = *run.click;
    bool turns = false;
    for (std::size_t e = 0; e < ears; ++e) {
        VoiceGains& own = *gains[e];
        own.look_again(run, ear[e], allowance);
        u_begin[e] = own.turns_ ? own.share(run.sample) : 0.0;
        const double u_end = own.turns_ ? own.share(run.sample + run.samples * run.every) : 1.0;
        u_step[e] = (u_end - u_begin[e]) / run.samples;
        // p = d/dt [r . D V / r^2 + r . D V' / (r c)], V = share U + W.
        const double least = run.table->near_limit();
        const auto ahead = [&](int samples, double& far) -> Vec3 {
            const Vec3 way = ear[e] - run.center - samples * run.pace;
            const double length = way.norm();
            far = std::max(length, least);
            return run.rotation.transpose() * (way / (std::max(length, 1e-12) * far));
        };
        double far = 0.0, far_then = 0.0;
        const Vec3 now = ahead(0, far), then = ahead(run.samples, far_then);
        const double per_u = u_end > u_begin[e] ? 1.0 / (u_end - u_begin[e]) : 0.0;
        const auto put = [&](AlignedFloats& begin, AlignedFloats& step, std::size_t at,
                             double first, double last) {
            const double slope = per_u * (last - first);
            begin[at] = static_cast<float>(first - u_begin[e] * slope);
            step[at] = static_cast<float>(slope);
        };
        const double forgot = click.forget / click.speed;
        for (int i = 0; i < 3; ++i) {
            const auto at = static_cast<std::size_t>(i);
            put(own.velocity_, own.velocity_step_, at, now[i] / far, then[i] / far_then);
            put(own.acceleration_, own.acceleration_step_, at, now[i] / click.speed,
                then[i] / click.speed);
            put(own.velocity_, own.velocity_step_, 3 + at,
                click.share * now[i] * (1.0 / far - forgot),
                click.share * then[i] * (1.0 / far_then - forgot));
        }
        by[e][0] = own.velocity_.data(), by[e][1] = own.acceleration_.data();
        by[ears + e][0] = own.velocity_step_.data();
        by[ears + e][1] = own.acceleration_step_.data();
        sum[e] = out[e], sum[ears + e] = change[e];
        constexpr double kTurned = 1e-4; // of the direction: 80 dB down
        turns = turns || own.turns_ || (now - then).norm() > kTurned * now.norm();
    }
    kernels().weigh(run.columns, run.samples, static_cast<int>(turns ? 2 * ears : ears), by,
                    run.amplitude, run.rate, sum);
    for (std::size_t e = 0; turns && e < ears; ++e) {
        const auto begin = static_cast<float>(u_begin[e]), step = static_cast<float>(u_step[e]);
        for (int s = 0; s < run.samples; ++s)
            out[e][s] += (begin + static_cast<float>(s) * step) * change[e][s];
    }
}

} // namespace ode::sound
