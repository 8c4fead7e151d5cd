#include "mix/listener.h"

#include "dsp/splat_table.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

/// A point at the samples of a run, as the kernel wants it.
struct Points {
    static constexpr int kMost = ModalRun::kMost;
    alignas(64) double position[4 * kMost];
    alignas(64) double softening[kMost];
    alignas(64) double flow[kMost];

    void put(int i, const Vec3& x, double soft, double value) noexcept {
        for (int k = 0; k < 3; ++k)
            position[4 * i + k] = x[k];
        position[4 * i + 3] = 0.0;
        softening[i] = soft;
        flow[i] = value;
    }
    SplatSurface surface(int points, double samples_per_metre) const noexcept {
        return {points,  position, nullptr,           softening,           flow,
                nullptr, nullptr,  samples_per_metre, splat_table().rows()};
    }
};

} // namespace

// As the other send() for one sample; here what the samples of a run have in common is worked out
// once.
void Listener::send(const ModalRun& run) {
    if (!ear_[0].path || !ear_[0].wave || (run.gain == 0.0 && run.gain_step == 0.0))
        return;
    if (run.click) {
        send_struck(run);
        return;
    }
    Voice& voice = find_voice(run.voice, *run.table);
    float heard[kEars][ModalRun::kMost];
    float* const out[kEars] = {heard[0], heard[1]};
    VoiceGains* gains[kEars];
    Vec3 place[kEars];
    for (int e = 0; e < ears_; ++e) {
        const EarPath::State& state = ear_[static_cast<std::size_t>(e)].path->at(run.sample);
        gains[e] = &voice.gains[static_cast<std::size_t>(e)];
        place[e] = state.ghost_share > 0.5 ? state.ghost : state.position;
    }
    const auto ears = static_cast<std::size_t>(ears_);
    VoiceGains::flow(run, {gains, ears}, {place, ears},
                     VoiceGains::kAllowance / static_cast<double>(ears * voice_.size()), out);
    for (int e = 0; e < ears_; ++e) {
        const EarPath::State state = ear_[static_cast<std::size_t>(e)].path->at(run.sample);
        if (state.ghost_share < 1.0) {
            Vec3 mach = state.velocity / settings_->air.speed;
            constexpr double kFastest = 0.9; // of the speed of sound, for the aim alone
            if (mach.norm() > kFastest)
                mach *= kFastest / mach.norm();
            send(run, e, heard[e], state.position, mach, 1.0 - state.ghost_share);
        }
        if (state.ghost_share > 0.0)
            send(run, e, heard[e], state.ghost, Vec3::Zero(), state.ghost_share);
    }
}

void Listener::send(const ModalRun& run, int e, const float* heard, const Vec3& place,
                    const Vec3& mach, double share) noexcept {
    Points modes, whole;
    Ear& ear = ear_[static_cast<std::size_t>(e)];
    SplatEar target = ear.wave->target(run.sample);
    for (int k = 0; k < 3; ++k) {
        target.position[k] = place[k];
        target.mach[k] = mach[k];
    }
    target.gain = share;
    const double per_gain = 1.0 / radiation_gain(settings_->radiation, settings_->air);
    const double per_sample = settings_->air.speed / settings_->send_rate(); // [m]
    const double least = run.table->near_limit();
    const int points = (run.samples + 3) / 4 * 4;
    // Seen from the ear, which goes on meanwhile.
    const Vec3 pace = run.pace - per_sample * mach;
    const Vec3 x = run.center + run.rotation * run.table->centre;
    const Vec3 offset = x - place;
    const double square = offset.squaredNorm(), twice = 2.0 * offset.dot(pace),
                 quick = pace.squaredNorm();
    for (int i = 0; i < points; ++i) {
        const double at = square + i * (twice + i * quick);
        // No nearer than the table tells: the distance that is used is the root of the sum.
        const double soft = std::max(1e-12, least * least - at);
        const double gain = i < run.samples ? per_gain * (run.gain + i * run.gain_step) *
                                                  static_cast<double>(heard[i])
                                            : 0.0;
        modes.put(i, x + i * pace, soft, gain * std::sqrt(at));
    }
    if (run.rigid) {
        // The direction is the same throughout: a run takes a third of a millisecond.
        const Vec3 way = place - run.center;
        const double off = std::max(way.norm(), least), radius = run.rigid->radius;
        const Vec3 towards = way.stableNormalized();
        const Vec3 near = run.center + radius * towards;
        const RigidSound::Six ahead =
            (off - radius) / off *
            (run.rigid->dipole.transpose() * (run.rotation.transpose() * towards));
        for (int i = 0; i < points; ++i) {
            double flow = 0.0;
            if (i < run.samples)
                flow = per_gain * (run.gain + i * run.gain_step) *
                       ahead.dot(run.velocity[i] / off + run.slope[i] / run.rigid->speed);
            whole.put(i, near + i * pace, modes.softening[i], flow);
        }
    }
    for (const Points* own : {&modes, run.rigid ? &whole : nullptr})
        if (own)
            ear.wave->note_arrival(
                static_cast<double>(run.sample) +
                kernels().splat_run(own->surface(points, 1.0 / per_sample), target));
}

} // namespace ode::sound
