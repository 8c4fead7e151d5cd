#include "mix/alarm.h"

#include "mix/scene.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {

Alarm::Watched& Alarm::find(const void* body) {
    const auto found = std::find_if(watched_.begin(), watched_.end(),
                                    [&](const Watched& own) { return own.body == body; });
    return found != watched_.end()
               ? *found
               : watched_.emplace_back(Watched{body, {0, false}, -HUGE_VAL, -HUGE_VAL});
}

void Alarm::update(Scene& scene, double time, Ask ask, const Tell& tell) {
    scene.for_each_body([&](const void* body, const BodySource& source) {
        const Fare fare = ask(body);
        Watched& own = find(body);
        const bool stopped = fare.stopped && !own.fare.stopped;
        const bool redone = fare.rollbacks > own.fare.rollbacks;
        const bool heard = source.grown_at() > own.heard;
        own.fare = fare;
        if (!stopped && !redone && !heard)
            return;
        const double when = heard ? source.grown_at() : time;
        own.heard = std::max(own.heard, source.grown_at());
        if (!stopped && when < own.raised + kQuiet) {
            own.raised = when; // it goes on
            return;
        }
        own.raised = last_ = when;
        ++count_;
        tell(body, when, stopped ? Cause::kStopped : heard ? Cause::kHeard : Cause::kRedone);
    });
}

void Alarm::forget(const void* body) noexcept {
    std::erase_if(watched_, [&](const Watched& own) { return own.body == body; });
}

} // namespace ode::sound
