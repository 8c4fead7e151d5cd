#include "mix/listener.h"

#include "dsp/splat_table.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

Listener::Listener(const Settings& settings, std::int64_t frame)
    : settings_(&settings), next_(frame) {
    restart();
}

void Listener::restart() {
    const Settings& s = *settings_;
    const double gain = radiation_gain(s.radiation, s.air);
    const bool differentiate = radiation_differentiates(s.radiation);
    shade_.clear(); // sources are made anew, too
    for (Ear& ear : ear_) {
        ear.path.reset(); // its grid may be another
        ear.wave.reset();
        ear.paper.reset();
    }
    for (Ear& ear : heard()) {
        if (s.sampling == Sampling::kSinc) {
            const Decimator decimator(
                s.rate, differentiate ? Decimator::Kind::kDerivative : Decimator::Kind::kSmooth,
                gain);
            ear.wave = std::make_unique<EarLine>(s.rate, next_, decimator,
                                                 differentiate ? std::nullopt
                                                               : std::optional<DcBlock>(DcBlock{}));
        } else {
            // Facets carry z v_n already, for all radiation models.
            ear.paper = std::make_unique<PaperLine>(
                s.rate, next_, gain / (s.air.density * s.air.speed), differentiate);
        }
    }
}

bool Listener::set_ears(int ears) {
    bool any = false;
    for_each_sink([&](const Sink&) { any = true; });
    if (any && ears != ears_)
        return false;
    if (ears == ears_)
        return true;
    ears_ = ears;
    ear_meter_ = {};
    voice_.clear();
    if (limiter_)
        limiter_.emplace(settings_->rate, ears_, limiter_->ceiling());
    restart();
    return true;
}

std::array<Vec3, Listener::kEars> Listener::places() const noexcept {
    return ears_ == 1 ? std::array<Vec3, kEars>{pose.centre, pose.centre} : pose.ears();
}

void Listener::begin_step(double time, double duration) {
    const double rate = settings_->send_rate();
    const std::array<Vec3, kEars> target = places();
    for (std::size_t e = 0; e < static_cast<std::size_t>(ears_); ++e) {
        if (!ear_[e].path)
            ear_[e].path = std::make_unique<EarPath>(rate, target[e]);
        else
            ear_[e].path->move_to(target[e], static_cast<std::int64_t>(std::floor(time * rate)),
                                  static_cast<int>(std::lround(duration * rate)));
    }
}

void Listener::splat(const FlowBlock& block, bool ghost, int only) noexcept {
    SplatEar target[kEars];
    int count = 0;
    EarLine* line[kEars];
    int which[kEars];
    for (int e = only < 0 ? 0 : only; e < (only < 0 ? ears_ : only + 1); ++e) {
        Ear& ear = ear_[static_cast<std::size_t>(e)];
        const EarPath::State& state = ear.path->at(block.sample);
        const double share = ghost ? state.ghost_share : 1.0 - state.ghost_share;
        if (share == 0.0)
            continue;
        SplatEar& to = target[count];
        to = ear.wave->target(block.sample);
        which[count] = e;
        line[count++] = ear.wave.get();
        to.gain = block.gain * share;
        const Vec3& place = ghost ? state.ghost : state.position;
        Vec3 mach = Vec3::Zero();
        if (!ghost) {
            mach = state.velocity / settings_->air.speed;
            constexpr double kFastest = 0.9; // of the speed of sound, for the aim alone
            if (mach.norm() > kFastest)
                mach *= kFastest / mach.norm();
        }
        for (int k = 0; k < 3; ++k) {
            to.position[k] = place[k];
            to.mach[k] = mach[k];
        }
    }
    if (count == 0)
        return;
    SplatSurface surface{block.nodes,          block.position,
                         block.area,           block.softening,
                         block.flow,           block.lean,
                         block.lean_flow,      settings_->send_rate() / settings_->air.speed,
                         splat_table().rows(), splat_table().moments()};
    const auto facing = static_cast<std::size_t>(
        block.lean ? Facing::kLeaning : radiation_facing(settings_->radiation));
    Shade* const shade = find_shade(block.source);
    if (shade)
        shade->advance(block.sample, settings_->send_rate());
    const bool hides = shade && !shade->is_clear();
    if (hides && block.patches && radiation_facing(settings_->radiation) != Facing::kAll) {
        for (int e = 0; e < count; ++e) {
            surface.flow = shade->scaled(which[e], *block.patches, block.flow);
            line[e]->note_arrival(static_cast<double>(block.sample) +
                                  kernels().splat[facing](surface, target + e, 1));
        }
        return;
    }
    for (int e = 0; hides && e < count; ++e)
        target[e].gain *= shade->share(which[e]);
    const double delay = kernels().splat[facing](surface, target, count);
    for (int e = 0; e < count; ++e)
        line[e]->note_arrival(static_cast<double>(block.sample) + delay);
}

void Listener::send(const FlowBlock& block) noexcept {
    if (!ear_[0].path || !ear_[0].wave || block.gain == 0.0)
        return;
    splat(block, false);
    for (Ear& ear : heard())
        if (ear.path->at(block.sample).ghost_share > 0.0) {
            splat(block, true);
            break;
        }
}

Listener::Voice& Listener::find_voice(const void* voice, const TransferTable& table,
                                      std::size_t lead) {
    // Voices come in the same order at every step: the next one is the likely one.
    for (std::size_t i = 0; i < voice_.size(); ++i) {
        const std::size_t at = (hint_ + i) % voice_.size();
        if (voice_[at].key == voice) {
            hint_ = at;
            return voice_[at];
        }
    }
    hint_ = voice_.size();
    return voice_.emplace_back(Voice{voice, {VoiceGains(table, lead), VoiceGains(table, lead)}});
}

void Listener::forget_voice(const void* voice) noexcept {
    std::erase_if(voice_, [&](const Voice& own) { return own.key == voice; });
    std::erase_if(shade_, [&](const Shaded& own) { return own.source == voice; });
}

void Listener::send(const ModalBlock& block) {
    if (!ear_[0].path || !ear_[0].wave || block.gain == 0.0)
        return;
    Voice& voice = find_voice(block.voice, *block.table);
    // Modes sound from the table's centre, the body's motion as a whole from the near side of the
    // sphere that it is likened to; four points for the kernel's sake.
    constexpr int kPoints = 4;
    alignas(64) double position[4 * kPoints] = {}, area[4 * kPoints] = {};
    alignas(64) double softening[kPoints], flow[kPoints] = {};
    const Vec3 centre = block.center + block.rotation * block.table->centre;
    const double least = block.table->near_limit();
    for (int i = 0; i < kPoints; ++i) {
        for (int k = 0; k < 3; ++k)
            position[4 * i + k] = centre[k];
    }
    const double per_gain = 1.0 / radiation_gain(settings_->radiation, settings_->air);
    for (int e = 0; e < ears_; ++e) {
        const EarPath::State& state = ear_[static_cast<std::size_t>(e)].path->at(block.sample);
        const Vec3 place = state.ghost_share > 0.5 ? state.ghost : state.position;
        // No nearer than the table tells: the distance that is used is the root of the sum.
        std::fill_n(softening, kPoints,
                    std::max(1e-12, least * least - (place - centre).squaredNorm()));
        if (block.rigid) {
            const Vec3 way = place - block.center;
            const double distance = std::max(way.norm(), least);
            const Vec3 towards = way.stableNormalized();
            for (int k = 0; k < 3; ++k)
                position[4 + k] = block.center[k] + block.rigid->radius * towards[k];
            flow[1] = per_gain * (distance - block.rigid->radius) *
                      block.rigid->flow(block.rotation.transpose() * towards, distance,
                                        block.velocity, block.slope);
        }
        flow[0] = per_gain * voice.gains[static_cast<std::size_t>(e)].flow(block, place);
        const FlowBlock one{block.sample, kPoints, position, area,         softening, flow,
                            nullptr,      nullptr, nullptr,  block.source, block.gain};
        splat(one, false, e);
        if (state.ghost_share > 0.0)
            splat(one, true, e);
    }
}

void Listener::send(const FacetBlock& block) noexcept {
    if (!ear_[0].path || !ear_[0].paper)
        return;
    const Facing facing = radiation_facing(settings_->radiation);
    const double per_metre = settings_->rate / settings_->air.speed;
    Shade* const shade = block.patches ? find_shade(block.source) : nullptr;
    if (shade)
        shade->advance(block.sample, settings_->send_rate());
    const bool hides = shade && !shade->is_clear();
    for (int e = 0; e < ears_; ++e) {
        Ear& ear = ear_[static_cast<std::size_t>(e)];
        const Vec3 r = ear.path->at(block.sample).position;
        for (int t = 0; t < block.facets; ++t) {
            const double* f = block.facet + static_cast<std::ptrdiff_t>(t) * FacetBlock::kFields;
            const Vec3 way = r - Vec3(f[2], f[3], f[4]);
            const double distance = std::max(way.norm(), 1e-6);
            const double cosine = way.dot(Vec3(f[5], f[6], f[7])) / distance;
            if (facing != Facing::kAll && cosine <= 0.0)
                continue;
            double s = block.gain * f[0] * f[1] / distance; // P01 eq. 10
            if (facing == Facing::kCosine)
                s *= cosine;
            else if (settings_->radiation == Radiation::kKirchhoff)
                s *= 1.0 + cosine;
            if (hides && facing == Facing::kAll)
                s *= shade->share(e);
            else if (hides)
                s *= shade->gain(e, block.patches->of[static_cast<std::size_t>(t)]);
            ear.paper->add(block.sample, distance * per_metre, s); // P01 eq. 11
        }
    }
}

Shade* Listener::find_shade(const void* source) const noexcept {
    const auto found = std::find_if(shade_.begin(), shade_.end(),
                                    [&](const Shaded& own) { return own.source == source; });
    return found != shade_.end() ? found->shade.get() : nullptr;
}

Shade& Listener::shade(const void* source) {
    if (Shade* found = find_shade(source))
        return *found;
    shade_.push_back({source, std::make_unique<Shade>()});
    return *shade_.back().shade;
}

void Listener::forget(const BodySource& source) noexcept {
    std::erase_if(shade_, [&](const Shaded& own) { return own.source == &source; });
}

void Listener::render(std::int64_t frame) noexcept {
    constexpr int kBlock = 256;
    double heard[kEars][kBlock];
    float out[kEars * kBlock];
    const double scale = 1.0 / settings_->full_scale;
    const auto channels = static_cast<std::size_t>(ears_);
    while (next_ < frame) {
        const auto count = static_cast<int>(std::min<std::int64_t>(kBlock, frame - next_));
        for (std::size_t e = 0; e < static_cast<std::size_t>(ears_); ++e)
            ear_[e].line().read(count, heard[e]);
        for (int f = 0; f < count; ++f)
            for (int e = 0; e < ears_; ++e) {
                meter_.add(heard[e][f]);
                ear_meter_[static_cast<std::size_t>(e)].add(heard[e][f]);
                out[ears_ * f + e] = static_cast<float>(scale * heard[e][f]);
            }
        if (limiter_)
            limiter_->run(out, count);
        for_each_sink([&](Sink& sink) {
            const auto wanted = static_cast<std::size_t>(count);
            std::size_t taken = 0;
            while (taken < wanted) {
                const std::size_t now = sink.write(
                    std::span<const float>(out + channels * taken, channels * (wanted - taken)));
                if (now == 0)
                    break;
                taken += now;
            }
            dropped_ += static_cast<std::int64_t>(wanted - std::min(taken, wanted));
        });
        next_ += count;
        frames_ += count;
    }
}

std::int64_t Listener::last_frame() const noexcept {
    std::int64_t last = next_;
    for (const Ear& ear : heard()) {
        const Line& line = ear.wave ? static_cast<const Line&>(*ear.wave) : *ear.paper;
        last = std::max(last, line.last_frame() + 1);
    }
    return last + (limiter_ ? limiter_->delay() : 0);
}

void Listener::set_limiter(double ceiling) {
    if (ceiling <= 0.0)
        limiter_.reset();
    else if (limiter_)
        limiter_->set_ceiling(ceiling);
    else
        limiter_.emplace(settings_->rate, ears_, ceiling);
}

Listener::Level Listener::take_level() noexcept {
    const Level level{ear_meter_, limiter_ ? limiter_->take_least_gain() : 1.0};
    ear_meter_ = {};
    return level;
}

bool Listener::add_sink(const std::shared_ptr<Sink>& sink) {
    if (has_sink(*sink))
        return true;
    if (!sink->open({settings_->rate, ears_}))
        return false;
    const bool pascals = settings_->radiation != Radiation::kPaper;
    sink->calibrate({settings_->full_scale, pascals ? "Pa" : "Pa m",
                     radiation_name(static_cast<int>(settings_->radiation)).data(),
                     sampling_name(static_cast<int>(settings_->sampling)).data(),
                     static_cast<double>(next_) / settings_->rate});
    sinks_.push_back(sink);
    return true;
}

void Listener::remove_sink(const Sink& sink) noexcept {
    std::erase_if(sinks_, [&](const std::weak_ptr<Sink>& own) {
        const std::shared_ptr<Sink> alive = own.lock();
        return !alive || alive.get() == &sink;
    });
}

bool Listener::has_sink(const Sink& sink) const noexcept {
    bool found = false;
    for_each_sink([&](const Sink& own) { found = found || &own == &sink; });
    return found;
}

} // namespace ode::sound
