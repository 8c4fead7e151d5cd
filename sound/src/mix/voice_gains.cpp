#include "mix/voice_gains.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

VoiceGains::VoiceGains(const TransferTable& table)
    : now_(table.mode.size()), next_(table.mode.size()), velocity_(table.mode.size()),
      acceleration_(table.mode.size()), velocity_step_(table.mode.size()),
      acceleration_step_(table.mode.size()), scratch_(table.scratch_size()) {}

void VoiceGains::look(const ModalBlock& block, const Vec3& ear) noexcept {
    const Vec3 place = block.rotation.transpose() * (ear - block.center);
    const bool anew = !known_ || block.sample - looked_ > 2 * kInterval;
    looked_ = block.sample;
    // The finest pattern has scratch_.size() lobes on the sphere: none has moved by a twentieth.
    constexpr double kSame = 0.05;
    const double lobe = place.norm() / std::sqrt(static_cast<double>(scratch_.size()));
    if (known_ && (place - place_).norm() < kSame * lobe) {
        std::fill(velocity_step_.begin(), velocity_step_.end(), 0.0f);
        std::fill(acceleration_step_.begin(), acceleration_step_.end(), 0.0f);
        for (std::size_t k = 0; k < next_.size(); ++k) {
            velocity_[k] = next_[k].velocity;
            acceleration_[k] = next_[k].acceleration;
        }
        return;
    }
    now_.swap(next_);
    block.table->gains(place, next_, scratch_);
    if (anew)
        now_ = next_;
    known_ = true;
    place_ = place;
    for (std::size_t k = 0; k < now_.size(); ++k) {
        velocity_[k] = now_[k].velocity;
        acceleration_[k] = now_[k].acceleration;
        velocity_step_[k] = next_[k].velocity - now_[k].velocity;
        acceleration_step_[k] = next_[k].acceleration - now_[k].acceleration;
    }
}

double VoiceGains::flow(const ModalBlock& block, const Vec3& ear) noexcept {
    if (!known_ || block.sample - looked_ >= kInterval || block.sample < looked_)
        look(block, ear);
    constexpr std::size_t kLanes = 8;
    float sum[kLanes] = {}, change[kLanes] = {};
    const auto add = [&](std::size_t k, std::size_t lane) {
        const float q = block.amplitude[k], v = block.rate[k];
        sum[lane] += velocity_[k] * q + acceleration_[k] * v;
        change[lane] += velocity_step_[k] * q + acceleration_step_[k] * v;
    };
    std::size_t k = 0;
    for (; k + kLanes <= velocity_.size(); k += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            add(k + lane, lane);
    for (; k < velocity_.size(); ++k)
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

} // namespace ode::sound
