#include "mix/voice_gains.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

VoiceGains::VoiceGains(const TransferTable& table)
    : now_(table.mode.size()), next_(table.mode.size()), scratch_(table.scratch_size()) {
    const std::size_t lanes = (now_.size() + kModeLanes - 1) / kModeLanes * kModeLanes;
    for (AlignedFloats* row : {&velocity_, &acceleration_, &velocity_step_, &acceleration_step_})
        row->assign(lanes, 0.0f);
}

bool VoiceGains::look(std::int64_t sample, const TransferTable& table, const Vec3& place) noexcept {
    const bool anew = !known_ || sample - looked_ > 64 * kInterval;
    looked_ = sample;
    // The finest pattern has scratch_.size() lobes on the sphere: none has moved by a twentieth.
    constexpr double kSame = 0.05;
    const double lobe = place.norm() / std::sqrt(static_cast<double>(scratch_.size()));
    if (known_ && (place - place_).norm() < kSame * lobe) {
        turns_ = false;
        std::fill(velocity_step_.begin(), velocity_step_.end(), 0.0f);
        std::fill(acceleration_step_.begin(), acceleration_step_.end(), 0.0f);
        for (std::size_t k = 0; k < next_.size(); ++k) {
            velocity_[k] = next_[k].velocity;
            acceleration_[k] = next_[k].acceleration;
        }
        return false;
    }
    now_.swap(next_);
    table.gains(place, next_, scratch_);
    if (anew)
        now_ = next_;
    known_ = true;
    turns_ = !anew;
    place_ = place;
    for (std::size_t k = 0; k < now_.size(); ++k) {
        velocity_[k] = now_[k].velocity;
        acceleration_[k] = now_[k].acceleration;
        velocity_step_[k] = next_[k].velocity - now_[k].velocity;
        acceleration_step_[k] = next_[k].acceleration - now_[k].acceleration;
    }
    return true;
}

double VoiceGains::flow(const ModalBlock& block, const Vec3& ear) noexcept {
    if (!known_ || block.sample - looked_ >= kInterval || block.sample < looked_)
        look(block.sample, *block.table, block.rotation.transpose() * (ear - block.center));
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
    const double share = static_cast<double>(block.sample - looked_) / kInterval;
    const Vec3 centre = block.center + block.rotation * block.table->centre;
    return (all + std::min(1.0, share) * slope) * (ear - centre).norm();
}

void VoiceGains::flow(const ModalRun& run, std::span<VoiceGains* const> gains,
                      std::span<const Vec3> ear, double allowance, float* const* out) noexcept {
    const float *by[2][2] = {}, *step[2][2] = {};
    float slope[2][ModalRun::kMost];
    float* const slopes[2] = {slope[0], slope[1]};
    bool turns = false;
    for (std::size_t e = 0; e < gains.size(); ++e) {
        VoiceGains& own = *gains[e];
        const auto cost = static_cast<double>(run.table->coefficient.size());
        own.credit_ = std::min(own.credit_ + allowance * run.samples, 2.0 * cost);
        const std::int64_t since = run.sample - own.looked_;
        const bool asks = since >= kInterval && own.credit_ >= cost;
        if (!own.known_ || asks || since < 0) {
            own.ramp_ = std::clamp<std::int64_t>(since, kInterval, 32 * kInterval);
            if (own.look(run.sample, *run.table, run.rotation.transpose() * (ear[e] - run.center)))
                own.credit_ -= cost;
        }
        by[e][0] = own.velocity_.data(), by[e][1] = own.acceleration_.data();
        step[e][0] = own.velocity_step_.data(), step[e][1] = own.acceleration_step_.data();
        turns = turns || own.turns_;
    }
    const auto ears = static_cast<int>(gains.size());
    kernels().weigh(run.columns, run.samples, ears, by, run.amplitude, run.rate, out);
    if (!turns)
        return;
    kernels().weigh(run.columns, run.samples, ears, step, run.amplitude, run.rate, slopes);
    for (std::size_t e = 0; e < gains.size(); ++e)
        for (int s = 0; s < run.samples; ++s) {
            const double share = static_cast<double>(run.sample + s - gains[e]->looked_) /
                                 static_cast<double>(gains[e]->ramp_);
            out[e][s] += static_cast<float>(std::min(1.0, share)) * slope[e][s];
        }
}

} // namespace ode::sound
