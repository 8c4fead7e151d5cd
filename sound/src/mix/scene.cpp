#include "mix/scene.h"

#include "source/paper_surface.h"
#include "source/surface_flow.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

Scene::Scene() = default;
Scene::~Scene() = default;

void Scene::set(const Settings& settings) {
    const bool level_only =
        settings.rate == settings_.rate && settings.radiation == settings_.radiation &&
        settings.sampling == settings_.sampling && settings.air.density == settings_.air.density &&
        settings.air.speed == settings_.air.speed;
    settings_ = settings;
    if (level_only)
        return;
    bodies_.clear();
    hint_ = 0;
    for (const auto& listener : listeners_) {
        listener->restart();
        if (stepping_)
            listener->begin_step(time_, 0.0);
    }
}

Listener& Scene::add_listener(double time) {
    if (listeners_.empty())
        time_ = time;
    const auto frame = static_cast<std::int64_t>(std::ceil(time * settings_.rate));
    listeners_.push_back(std::make_unique<Listener>(settings_, frame));
    if (stepping_)
        listeners_.back()->begin_step(time_, 0.0);
    return *listeners_.back();
}

void Scene::remove_listener(Listener& listener) noexcept {
    const auto at = std::find_if(listeners_.begin(), listeners_.end(),
                                 [&](const auto& own) { return own.get() == &listener; });
    if (at == listeners_.end())
        return;
    count_.frames += static_cast<unsigned long>(listener.frames());
    gone_.add(listener.meter());
    listeners_.erase(at);
    if (listeners_.empty()) {
        // Nobody observes from here on: what the sources know will be stale.
        bodies_.clear();
        hint_ = 0;
        stepping_ = false;
        duration_ = 0.0;
    }
}

Scene::Body* Scene::known(const void* body) noexcept {
    if (hint_ < bodies_.size() && bodies_[hint_].key == body)
        return &bodies_[hint_];
    for (hint_ = 0; hint_ < bodies_.size(); ++hint_)
        if (bodies_[hint_].key == body)
            return &bodies_[hint_];
    return nullptr;
}

Scene::Body& Scene::find(const void* body, std::span<const int> triangle) {
    if (Body* own = known(body))
        return *own;
    std::unique_ptr<BodySource> source;
    if (settings_.sampling == Sampling::kSinc)
        source = std::make_unique<SurfaceFlow>(
            triangle, settings_.rate, radiation_leaning(settings_.radiation), settings_.air.speed);
    else
        source = std::make_unique<PaperSurface>(triangle, settings_.rate,
                                                settings_.air.density * settings_.air.speed,
                                                settings_.radiation == Radiation::kPaper);
    const double loud = gain(body);
    bodies_.push_back({body, std::move(source), nullptr, nullptr, loud, loud});
    return bodies_.back();
}

void Scene::begin_step(double time) {
    stepping_ = true;
    for (const auto& listener : listeners_)
        listener->begin_step(time, duration_);
}

void Scene::push(const void* body, std::span<const int> triangle, const SurfaceView& view) {
    if (!stepping_)
        begin_step(view.time - view.dt);
    ++count_.substeps;
    Body& own = find(body, triangle);
    if (own.gain == 0.0 && own.now == 0.0) // silenced: the source will take it for sleep
        return;
    sounding_ = &own;
    own.heard = true;
    if (own.source->push(view, *this))
        ++count_.gathers;
}

StruckVoice& Scene::add_struck(const void* body, std::shared_ptr<const StruckVoiceModel> model) {
    const double loud = gain(body);
    bodies_.push_back({body, nullptr, nullptr,
                       std::make_unique<StruckVoice>(std::move(model), settings_.rate), loud,
                       loud});
    return *bodies_.back().struck;
}

StruckVoice* Scene::find_struck(const void* body) noexcept {
    std::size_t anywhere = 0;
    return find_struck(body, anywhere);
}

StruckVoice* Scene::find_struck(const void* body, std::size_t& likely) noexcept {
    if (likely >= bodies_.size() || bodies_[likely].key != body || !bodies_[likely].struck) {
        const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const Body& own) {
            return own.key == body && own.struck;
        });
        if (found == bodies_.end())
            return nullptr;
        likely = static_cast<std::size_t>(found - bodies_.begin());
    }
    return bodies_[likely].struck.get();
}

void Scene::set_gain(const void* body, double gain) {
    std::erase_if(gain_, [&](const Gain& own) { return own.key == body; });
    if (gain != 1.0)
        gain_.push_back({body, gain});
    for (Body& own : bodies_)
        if (own.key == body)
            own.gain = gain;
}

double Scene::gain(const void* body) const noexcept {
    const auto found =
        std::find_if(gain_.begin(), gain_.end(), [&](const Gain& own) { return own.key == body; });
    return found != gain_.end() ? found->gain : 1.0;
}

double Scene::next_gain(double rate) noexcept {
    const double step = 1.0 / (kGainTime * rate);
    Body& own = *sounding_;
    own.now += std::clamp(own.gain - own.now, -step, step);
    return own.now;
}

void Scene::end_body(const void* body) noexcept {
    std::erase_if(gain_, [&](const Gain& own) { return own.key == body; });
    for (Body& own : bodies_)
        if (own.key == body)
            own.key = nullptr; // what it did last is still to be heard
}

void Scene::end_step(double time, double settled) {
    if (!stepping_)
        begin_step(time_);
    for (Body& body : bodies_) {
        sounding_ = &body;
        if (body.source)
            body.source->advance_to(time, *this);
        if (body.voice)
            body.voice->advance_to(time, *this);
        if (body.struck && !body.key)
            body.struck->finish(*this);
        if (body.is_silent())
            body.now = body.gain; // nobody hears it jump
    }
    std::erase_if(bodies_, [&](Body& body) {
        if (body.key || !body.is_silent())
            return false;
        end_voice(body);
        for (const auto& listener : listeners_) {
            if (body.source)
                listener->forget(*body.source);
            listener->forget_voice(body.struck.get());
        }
        return true;
    });
    // Sound comes later while a body of long substeps is there; none of it is lost.
    int lag = settings_.lag();
    for (const Body& body : bodies_)
        lag = std::max(lag, body.source ? body.source->lag() : 0);
    const std::int64_t open = settings_.first_open_frame(settled, lag);
    for (const auto& listener : listeners_)
        listener->render(open);
    stepping_ = false;
    duration_ = time - time_;
    time_ = time;
}

void Scene::finish() {
    constexpr double kSettled = 0.1; // [s]: longer than any source takes to fall silent
    for (Body& body : bodies_) {
        sounding_ = &body;
        if (body.source)
            body.source->advance_to(time_ + kSettled, *this);
        if (body.voice)
            body.voice->advance_to(time_ + kSettled, *this);
        if (body.struck)
            body.struck->finish(*this);
    }
    for (const auto& listener : listeners_)
        listener->render(listener->last_frame());
}

void Scene::on_flow(const FlowBlock& block) noexcept {
    // A ghost shares its sample with the block before it: the ramp is that much shorter.
    FlowBlock own = block;
    own.gain *= next_gain(settings_.send_rate());
    for (const auto& listener : listeners_)
        listener->send(own);
}

void Scene::on_facets(const FacetBlock& block) noexcept {
    FacetBlock own = block;
    own.gain *= next_gain(settings_.send_rate());
    for (const auto& listener : listeners_)
        listener->send(own);
}

double Scene::nearest_ear(const Vec3& place) const noexcept {
    double least = HUGE_VAL;
    for (const auto& listener : listeners_)
        for (const Vec3& ear : listener->places())
            least = std::min(least, (ear - place).squaredNorm());
    return std::sqrt(least);
}

void Scene::on_modes(const ModalBlock& block) noexcept {
    count_.mode_samples += block.amplitude.size();
    count_.inaudible_samples += sounding_->voice->modes() - block.amplitude.size();
    ModalBlock own = block;
    own.source = sounding_->source.get();
    own.gain *= next_gain(settings_.send_rate());
    for (const auto& listener : listeners_)
        listener->send(own);
}

void Scene::on_modal_run(const ModalRun& run) noexcept {
    const auto samples = static_cast<unsigned long>(run.samples);
    const std::size_t modes = run.table->mode.size();
    const std::size_t heard =
        std::min(modes, static_cast<std::size_t>(run.columns) - ClickColumns::kCount);
    count_.mode_samples += samples * heard;
    count_.inaudible_samples += samples * (modes - heard);
    ModalRun own = run;
    const double before = sounding_->now;
    const double after = next_gain(settings_.send_rate() / (run.every * run.samples));
    own.gain_step = run.gain * (after - before) / run.samples;
    own.gain = run.gain * before + own.gain_step;
    for (const auto& listener : listeners_)
        listener->send(own);
}

void Scene::end_voice(Body& body) noexcept {
    if (!body.voice)
        return;
    for (const auto& listener : listeners_)
        listener->forget_voice(body.voice.get());
    body.voice.reset();
}

Scene::Count Scene::count() const noexcept {
    Count count = count_;
    Meter meter = gone_;
    for (const auto& listener : listeners_) {
        count.frames += static_cast<unsigned long>(listener->frames());
        meter.add(listener->meter());
    }
    count.peak = meter.peak();
    count.rms = meter.rms();
    return count;
}

} // namespace ode::sound
