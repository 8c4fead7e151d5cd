#include "source/surface_flow.h"

#include "dsp/kernels.h"
#include "dsp/step_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kGathersPerSample =
    8.0;                                // box filter: -0.08 dB at 20 kHz, first image above 360 kHz
constexpr double kAreaSamples = 2.0;    // areas are steps of half the audio rate: inaudible
constexpr double kMaxStretch = 64.0;    // substeps up to 533 us at 48 kHz are free of images
constexpr double kEven = 0.02;          // intervals are of equal length
constexpr double kUneven = 0.5;         // of an interval, where they aren't: see wanted()
constexpr double kCrossOver = 4e-3;     // after a jump [s]
constexpr double kLeastDistance = 1e-6; // of a node that bears no area [m]

} // namespace

SurfaceFlow::SurfaceFlow(std::span<const int> triangle, double rate, Leaning leaning, double speed)
    : surface_(triangle), rate_(rate), grid_rate_(kOversampling * rate),
      interval_(1.0 / (kGathersPerSample * rate)), leaning_(leaning), speed_(speed),
      history_(surface_.nodes(), 1), fade_(surface_.nodes()), places_(surface_.nodes(), 1),
      last_(4 * static_cast<std::size_t>(surface_.nodes())), area_(last_.size()),
      area_seen_(last_.size()), softening_(last_.size() / 4), flow_(last_.size()) {}

bool SurfaceFlow::push(const SurfaceView& view, BlockSink& out) {
    const double gap = view.time - view.dt - seen_;
    if (state_ != State::kMoving || std::abs(gap) > 0.5 * view.dt)
        wake(view, out);
    seen_ = view.time;
    substep_ = view.dt;
    adapt(view.dt);
    if (view.time - event_end_ + 0.5 * view.dt < wanted())
        return false;
    record(view, out);
    return true;
}

/// What ultrasound does within an interval is guessed from its neighbours (FlowHistory); where
/// intervals differ in length the guess's errors are noise, which halved intervals bring from -82
/// dB to -104.
double SurfaceFlow::wanted() const noexcept {
    return event_end_ < dense_until_ ? kUneven * interval_ : interval_;
}

bool SurfaceFlow::is_shortest() const noexcept {
    return interval_ <= 1.0 / (kGathersPerSample * rate_);
}

void SurfaceFlow::wake(const SurfaceView& view, BlockSink& out) {
    const double begin = view.time - view.dt;
    if (state_ == State::kMoving)
        stop();
    if (state_ == State::kResting)
        rest_until(begin, out);
    rewind(view, view.dt);
    if (!lean_)
        lean_.emplace(leaning_, surface_, last_.data(), area_.data(), grid_rate_, speed_);
    adapt(view.dt);
    if (state_ == State::kSilent)
        start(begin);
    state_ = State::kMoving;
    event_end_ = begin;
    entering_ = true;
}

void SurfaceFlow::adapt(double substep) {
    const double shortest = 1.0 / (kGathersPerSample * rate_);
    const bool fits = substep <= interval_ && (interval_ == shortest || substep > 0.5 * interval_);
    if (fits && history_.capacity() > 1)
        return;
    // Intervals longer than a grid sample would leave images of the body's motion in the pass band:
    // the low-pass is stretched until its stop band begins below the first of them. Some slack, so
    // that wavering substeps do not change the filter each time.
    interval_ = substep > shortest ? 1.25 * substep : shortest;
    stretch_ = std::clamp(interval_ * grid_rate_, 1.0, kMaxStretch);
    lag_ = std::max(lag_, static_cast<int>(StepKernel::kHalfWidth * stretch_) + 8);
    // An interval is at least two thirds of the wanted one (push() rounds to whole substeps).
    const double span = 2.0 * StepKernel::kHalfWidth * stretch_ + 8.0; // grid samples
    history_.reserve(4 + static_cast<int>(1.5 * span / (interval_ * grid_rate_)));
    places_.reserve(12 +
                    static_cast<int>(StepKernel::kHalfWidth * stretch_ + interval_ * grid_rate_));
}

void SurfaceFlow::start(double time) {
    history_.clear();
    lean_->reset();
    fade_.stop();
    // The kernel reaches back: outputs before the first interval hear of it.
    const std::int64_t now = static_cast<std::int64_t>(std::floor(time * grid_rate_));
    next_ = now - static_cast<std::int64_t>(StepKernel::kHalfWidth * stretch_);
    for (std::int64_t o = next_; o <= now; ++o)
        std::copy(last_.begin(), last_.end(), places_.at(o));
    places_.set_newest(now);
}

void SurfaceFlow::rewind(const SurfaceView& view, double duration) {
    for (int i = 0; i < surface_.nodes(); ++i) {
        const std::ptrdiff_t node =
            static_cast<std::ptrdiff_t>(surface_.body_node()[i]) * view.stride;
        for (int k = 0; k < 3; ++k)
            last_[static_cast<std::size_t>(4 * i + k)] =
                view.position[node + k] - duration * view.velocity[node + k];
    }
    surface_.areas(last_.data(), area_.data());
    area_seen_ = area_;
    refreshed_ = view.time - duration;
    double area = 0.0, far = 0.0; // squares
    for (int i = 0; i < 4 * surface_.nodes(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        area += area_[k] * area_[k];
        far = std::max(far, last_[k] * last_[k]);
    }
    constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
    watch_.set_floor(GrowthWatch::kGain * kRounding * kRounding * far * area);
    for (std::size_t i = 0; i < softening_.size(); ++i) {
        // A disk of the node's area has at its centre the potential of a point sqrt(a / (4 pi))
        // away.
        const double* a = area_.data() + 4 * i;
        const double size = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
        softening_[i] = std::max(size / (4.0 * std::numbers::pi), kLeastDistance * kLeastDistance);
    }
}

bool SurfaceFlow::has_jumped(const SurfaceView& view, double duration) const noexcept {
    // Four nodes tell: a jump moves the body as a whole, and a turn leaves one axis alone.
    constexpr double kSlack = 50.0; // [m/s] by which position may outrun the reported velocity
    for (int k = 0; k < 4; ++k) {
        const int i = k * surface_.nodes() / 4;
        const std::ptrdiff_t node =
            static_cast<std::ptrdiff_t>(surface_.body_node()[i]) * view.stride;
        double moved = 0.0;
        double speed = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double d = view.position[node + c] - last_[static_cast<std::size_t>(4 * i + c)];
            moved += d * d;
            speed += view.velocity[node + c] * view.velocity[node + c];
        }
        if (std::sqrt(moved) > duration * (kSlack + 2.0 * std::sqrt(speed)))
            return true;
    }
    return false;
}

void SurfaceFlow::record(const SurfaceView& view, BlockSink& out) {
    const double begin = event_end_;
    const double duration = view.time - begin;
    const bool jumped = !entering_ && has_jumped(view, duration);
    if (jumped) {
        places_.jump(last_.data(), places_.newest() + 1, static_cast<int>(kCrossOver * grid_rate_));
        rewind(view, duration);
    }
    if (entering_) {
        // Flow before the break: the end of a rest that was cut short, or nothing.
        const double scale = history_.size() > 0 ? 1.0 / history_.duration(0) : 0.0;
        const double* before = history_.volume(0);
        for (int i = 0; i < surface_.nodes(); ++i)
            fade_.value()[i] = scale > 0.0 ? scale * before[i] : 0.0;
    }

    const Kernels& kernel = kernels();
    const auto newest = static_cast<std::int64_t>(std::floor(view.time * grid_rate_));
    for (std::int64_t o = places_.newest() + 1; o <= newest; ++o) {
        const double at = static_cast<double>(o) / grid_rate_;
        kernel.between(surface_.nodes(), surface_.body_node(), view.position, view.stride,
                       last_.data(), std::clamp((at - begin) / duration, 0.0, 1.0), places_.at(o));
    }
    places_.set_newest(std::max(newest, places_.newest()));
    const double window = 2.0 * StepKernel::kHalfWidth * stretch_ / grid_rate_;
    const bool dense = begin < dense_until_;
    if (std::abs(duration - last_length_) > kEven * duration) {
        uneven_until_ = view.time + 2.0 * window;
        // Not where this path itself has gone over to other intervals.
        if (dense == was_dense_ && last_length_ > 0.0 && is_shortest()) {
            if (dense_until_ == 0.0)
                history_.reserve(static_cast<int>(history_.capacity() / kUneven));
            dense_until_ = uneven_until_;
        }
    }
    was_dense_ = dense;
    last_length_ = duration;
    history_.set_sloped(view.time < uneven_until_ || !is_shortest());
    double* volume = history_.push(begin, view.time, false);
    kernel.gather(surface_.nodes(), surface_.body_node(), view.position, view.stride, area_.data(),
                  last_.data(), volume);
    const bool fresh = begin == refreshed_;
    if (watch_.look(history_, !entering_ && !jumped && fresh == was_fresh_))
        grown_at_ = view.time;
    was_fresh_ = fresh;
    if (entering_) {
        for (int i = 0; i < surface_.nodes(); ++i)
            fade_.value()[i] -= volume[i] / duration;
        std::fill_n(fade_.slope(), surface_.nodes(), 0.0);
        fade_.begin(begin);
        entering_ = false;
    }
    if (fade_.is_active(begin))
        fade_.add(begin, view.time, volume);
    event_end_ = view.time;
    if (view.time - refreshed_ + 0.5 * interval_ >= kAreaSamples / rate_)
        refresh_areas(view.time);
    give_off(out);
}

void SurfaceFlow::refresh_areas(double time) {
    surface_.areas(last_.data(), area_.data());
    for (std::size_t i = 0; i < area_.size(); ++i) {
        const double now = area_[i];
        area_[i] = 1.5 * now - 0.5 * area_seen_[i];
        area_seen_[i] = now;
    }
    refreshed_ = time;
}

const Patches& SurfaceFlow::patches(std::span<std::array<double, 3>> centre) {
    if (patches_.count == 0)
        patches_ = Patches(last_.data(), surface_.nodes(), 4);
    patches_.centres(last_.data(), 4, centre);
    return patches_;
}

void SurfaceFlow::stop() {
    const int nodes = surface_.nodes();
    std::fill_n(fade_.value(), nodes, 0.0);
    std::fill_n(fade_.slope(), nodes, 0.0);
    if (history_.size() > 0)
        for (int i = 0; i < nodes; ++i)
            fade_.value()[i] = history_.volume(0)[i] / history_.duration(0);
    if (history_.size() > 1) {
        const double lapse = 0.5 * (history_.duration(0) + history_.duration(1));
        for (int i = 0; i < nodes; ++i)
            fade_.slope()[i] =
                (fade_.value()[i] - history_.volume(1)[i] / history_.duration(1)) / lapse;
    }
    fade_.begin(event_end_);
    rest_begin_ = event_end_;
    state_ = State::kResting;
}

void SurfaceFlow::advance_to(double time, BlockSink& out) {
    if (state_ == State::kMoving && time > seen_ + 0.5 * substep_)
        stop();
    if (state_ == State::kResting)
        rest_until(time, out);
}

void SurfaceFlow::rest_until(double time, BlockSink& out) {
    const double reach = StepKernel::kHalfWidth * stretch_ / grid_rate_;
    const double end = rest_begin_ + FlowFade::kValueTime + 2.0 * reach + 8.0 / grid_rate_;
    const double least = 0.1 * interval_; // rounding of the step's end is no interval
    while (event_end_ + least < time) {
        if (event_end_ > end) {
            state_ = State::kSilent;
            return;
        }
        const double begin = event_end_;
        event_end_ = std::min(begin + interval_, time);
        const bool fading = fade_.is_active(begin);
        double* volume = history_.push(begin, event_end_, !fading);
        std::fill_n(volume, surface_.nodes(), 0.0);
        if (fading)
            fade_.add(begin, event_end_, volume);
        const auto newest = static_cast<std::int64_t>(std::floor(event_end_ * grid_rate_));
        for (std::int64_t o = places_.newest() + 1; o <= newest; ++o)
            std::copy(last_.begin(), last_.end(), places_.at(o));
        places_.set_newest(std::max(newest, places_.newest()));
        give_off(out);
    }
}

void SurfaceFlow::give_off(BlockSink& out) {
    const double reach = StepKernel::kHalfWidth * stretch_;
    const auto ready = static_cast<std::int64_t>(std::floor(event_end_ * grid_rate_ - reach));
    const auto nodes = static_cast<std::size_t>(surface_.nodes());
    double* const flow[4] = {flow_.data(), flow_.data() + nodes, flow_.data() + 2 * nodes,
                             flow_.data() + 3 * nodes};
    for (; next_ + 3 <= ready; next_ += 4) {
        const double first = static_cast<double>(next_) / grid_rate_;
        if (!history_.low_pass(first, 1.0 / grid_rate_, stretch_, flow)) {
            lean_->reset();
            continue;
        }
        const bool leans = lean_->leans();
        if (leans)
            lean_->aim(places_.at(next_), area_.data());
        for (int j = 0; j < 4; ++j) {
            const std::int64_t sample = next_ + j;
            const double ghost = places_.ghost_share(sample);
            if (leans)
                lean_->follow(flow[j]);
            FlowBlock block{sample,
                            surface_.nodes(),
                            places_.at(sample),
                            area_.data(),
                            softening_.data(),
                            flow[j],
                            leans ? lean_->direction() : nullptr,
                            leans ? lean_->flow() : nullptr,
                            patches_.count > 0 ? &patches_ : nullptr,
                            this,
                            1.0 - ghost};
            out.on_flow(block);
            if (ghost > 0.0) {
                block.position = places_.ghost();
                block.gain = ghost;
                out.on_flow(block);
            }
        }
    }
}

} // namespace ode::sound
