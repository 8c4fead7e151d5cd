// What isn't linear of a motion in modes.
#include "reduced/modal_motion.h"
#include "reduced/mode_rows.h"

#include <algorithm>

namespace ode::soft {

void ModalMotion::set_cubic(std::shared_ptr<const CubicTerms> terms) {
    use_cubic(false);
    following_.work = terms->make_work();
    for (AlignedVector<double>* q : {&following_.place, &following_.speed})
        q->assign(terms->columns(), 0.0);
    for (AlignedVector<float>* q : {&following_.single_place, &following_.single_speed})
        q->assign(terms->columns(), 0.0f);
    const std::size_t heard = terms->sounding().order.size();
    for (AlignedVector<double>* q : {&following_.shown_amplitude, &following_.shown_rate})
        q->assign(heard, 0.0);
    cubic_.emplace(std::move(terms), basis_->omega);
}

void ModalMotion::use_cubic(bool on) noexcept {
    level();
    foreseen_ = 0;
    bends_ = on && cubic_;
    if (bends_)
        cubic_->restart();
}

void ModalMotion::level() noexcept {
    if (!bends_ || cubic_->lag() == 0)
        return;
    cubic_->close(state_.amplitude, state_.rate);
    foreseen_ = 0;
}

void ModalMotion::begin_kicks(double dt) noexcept {
    if (bends_)
        cubic_->begin(dt, state_.amplitude, state_.rate);
}

void ModalMotion::find_following() const noexcept {
    cubic_->terms().follow(state_.amplitude, state_.rate, following_.place, following_.speed,
                           following_.work);
}

std::optional<ModalMotion::Followers> ModalMotion::followers() const noexcept {
    if (!bends_ || cubic_->terms().following() == 0)
        return std::nullopt;
    find_following();
    const CubicTerms& terms = cubic_->terms();
    const auto spread = [&](const AlignedVector<double>& q, AlignedVector<float>& single) {
        std::transform(q.begin(), q.end(), single.begin(),
                       [](double x) { return static_cast<float>(x); });
        return Spread(terms.shape().data(), terms.columns(), std::span<const float>(single));
    };
    return Followers{spread(following_.place, following_.single_place),
                     spread(following_.speed, following_.single_speed)};
}

ModalMotion::Shown ModalMotion::shown() const noexcept {
    if (!cubic_)
        return {state_.amplitude.data(), state_.rate.data(), basis_->audible};
    if (bends_) {
        find_following();
    } else {
        std::fill(following_.place.begin(), following_.place.end(), 0.0);
        std::fill(following_.speed.begin(), following_.speed.end(), 0.0);
    }
    const std::span<const int> order = cubic_->terms().sounding().order;
    const double lag = bends_ ? cubic_->lag() : 0;
    for (std::size_t c = 0; c < order.size(); ++c) {
        const auto k = static_cast<std::size_t>(order[c]);
        const bool follows = k >= basis_->audible;
        double& rate = following_.shown_rate[c];
        following_.shown_amplitude[c] =
            follows ? following_.place[k - basis_->audible] : state_.amplitude[k];
        rate = follows ? following_.speed[k - basis_->audible] : state_.rate[k];
        if (k < cubic_->force().size())
            rate += lag * cubic_->force()[k];
    }
    return {following_.shown_amplitude.data(), following_.shown_rate.data(), order.size()};
}

} // namespace ode::soft
