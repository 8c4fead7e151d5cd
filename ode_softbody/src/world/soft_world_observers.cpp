// What observers are told, and when.
#include "base/stopwatch.h"
#include "world/soft_world.h"

namespace ode::soft {

void SoftWorld::drop_past_observers() noexcept {
    if (busy() || past_observer_.empty())
        return;
    std::erase(observer_, nullptr);
    past_observer_.clear();
}

void SoftWorld::show_substep(double time, double dt) noexcept {
    // A step that is redone shows what has not been shown yet: observers can't take back.
    if (not_shown_until_ > time_) {
        if (time <= not_shown_until_ + dt / 2)
            return;
        dt = time - not_shown_until_;
        not_shown_until_ = 0;
    }
    shown_ = time;
    const Stopwatch watch;
    if (!exchange_.pushes().empty())
        each_observer([&](Observer& observer) {
            if (observer.wants_pushes())
                observer.on_pushes(time, dt, exchange_.pushes());
        });
    for (const auto& body : body_) {
        if (!body->moves())
            continue;
        each_observer([&](Observer& observer) {
            if (!observer.wants_substeps())
                return;
            observer.on_substep({*body, time, dt});
            ++stats_.observer_calls;
        });
    }
    stats_.observer_seconds += watch.seconds();
}

void SoftWorld::watch_move() noexcept {
    const Stopwatch watch;
    each_observer([&](Observer& observer) { observer.on_moved(*this, time_); });
    const double spent = watch.seconds();
    stats_.observer_seconds += spent;
    stats_.seconds += spent;
}

void SoftWorld::watch_step() noexcept {
    const Stopwatch watch;
    each_observer([&](Observer& observer) { observer.on_step(*this, time_); });
    const double spent = watch.seconds();
    stats_.observer_seconds += spent;
    stats_.seconds += spent;
}

} // namespace ode::soft
