#include "mix/listener.h"

#include "dsp/splat_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ode::sound {
namespace {

/// How far a wave goes that is sent from x to an ear at `place` which moves on with `mach` times
/// the speed of sound, and what part of it the ear is off at first: |x + u T| = c T.
double way_of(const Vec3& x, const Vec3& place, const Vec3& mach, double least) noexcept {
    const Vec3 offset = place - x;
    const double square = std::max(offset.squaredNorm(), least * least);
    const double rest = 1.0 - mach.squaredNorm(), ahead = offset.dot(mach);
    return (ahead + std::sqrt(ahead * ahead + rest * square)) / rest;
}

} // namespace

// A struck body is one point on its way to an ear: modes and click have been brought together.
void Listener::send(const ModalRun& run) {
    if (!ear_[0].path || !ear_[0].wave || (run.gain == 0.0 && run.gain_step == 0.0))
        return;
    Voice& voice = find_voice(run.voice, *run.table, ClickColumns::kCount);
    const auto ears = static_cast<std::size_t>(ears_);
    float heard[kEars][ModalRun::kMost];
    float* const out[kEars] = {heard[0], heard[1]};
    VoiceGains* gains[kEars];
    std::array<Vec3, kEars> place;
    std::array<EarPath::State, kEars> state;
    for (std::size_t e = 0; e < ears; ++e) {
        state[e] = ear_[e].path->at(run.sample);
        gains[e] = &voice.gains[e];
        place[e] = state[e].ghost_share > 0.5 ? state[e].ghost : state[e].position;
    }
    VoiceGains::pressure_flow(run, {gains, ears}, {place.data(), ears},
                              VoiceGains::kAllowance / static_cast<double>(ears * voice_.size()),
                              out);
    // Of the cells of the grid only one in `every` is told: the others' share comes with it.
    const double scale = run.every / radiation_gain(settings_->radiation, settings_->air);
    Shade* const shade = find_shade(run.voice);
    const bool hides = shade && !shade->is_clear();
    double seen[kEars] = {1.0, 1.0}, seen_step[kEars] = {};
    for (std::size_t e = 0; hides && e < ears; ++e)
        seen[e] = shade->share(static_cast<int>(e));
    if (hides)
        shade->advance(run.sample, settings_->send_rate(), run.samples * run.every);
    for (std::size_t e = 0; hides && e < ears; ++e)
        seen_step[e] = (shade->share(static_cast<int>(e)) - seen[e]) / run.samples;
    for (std::size_t e = 0; e < ears; ++e) {
        for (int i = 0; hides && i < run.samples; ++i)
            heard[e][i] *= static_cast<float>(seen[e] + (i + 1) * seen_step[e]);
        for (int i = 0; i < run.samples; ++i)
            heard[e][i] *= static_cast<float>(scale * (run.gain + i * run.gain_step));
        if (state[e].ghost_share < 1.0) {
            Vec3 mach = state[e].velocity / settings_->air.speed;
            constexpr double kFastest = 0.9; // of the speed of sound, for the aim alone
            if (mach.norm() > kFastest)
                mach *= kFastest / mach.norm();
            send_struck(run, e, heard[e], state[e].position, mach, 1.0 - state[e].ghost_share);
        }
        if (state[e].ghost_share > 0.0)
            send_struck(run, e, heard[e], state[e].ghost, Vec3::Zero(), state[e].ghost_share);
    }
}

void Listener::send_struck(const ModalRun& run, std::size_t e, const float* heard,
                           const Vec3& place, const Vec3& mach, double share) noexcept {
    EarLine& line = *ear_[e].wave;
    const double per_metre = settings_->send_rate() / settings_->air.speed;
    const double least = run.table->near_limit();
    // Seen from the ear, which goes on meanwhile; a parabola through three of the ways, since a
    // run takes less than two milliseconds.
    const Vec3 pace = run.pace - run.every / per_metre * mach;
    double way[3];
    for (int i = 0; i < 3; ++i)
        way[i] = way_of(run.center + 0.5 * i * run.samples * pace, place, mach, least);
    const double n = run.samples;
    SpreadRun spread{};
    spread.samples = run.samples;
    spread.every = run.every;
    spread.delay = per_metre * std::max(0.0, way[0] - run.click->radius);
    spread.pace = per_metre * (4.0 * way[1] - 3.0 * way[0] - way[2]) / n;
    spread.bend = per_metre * 2.0 * (way[2] - 2.0 * way[1] + way[0]) / (n * n);
    spread.table = splat_table().float_rows();
    const double last = spread.delay + (n - 1.0) * (spread.pace + (n - 1.0) * spread.bend);
    // What comes as fast as sound piles up, or comes the last first: that can't be heard as waves.
    const double quickest = std::fabs(spread.pace) + 2.0 * n * std::fabs(spread.bend);
    if (!(quickest < 0.9 * run.every) || !(std::max(spread.delay, last) < 1e9))
        return;
    float value[ModalRun::kMost];
    for (int i = 0; i < run.samples; ++i)
        value[i] = static_cast<float>(share) * heard[i];
    spread.value = value;
    if (last < 0.0) // inside the sphere
        spread.pace = spread.bend = 0.0;
    kernels().spread(spread, line.target(run.sample));
    line.note_arrival(static_cast<double>(run.sample) + std::max(spread.delay, last) +
                      run.every * n);
}

} // namespace ode::sound
